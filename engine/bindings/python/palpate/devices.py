"""Devices: listing them, opening one, and servo loops over them.

    for back_end in palpate.devices.probe():
        print(back_end["name"], back_end["available"], back_end["reason"])

    with palpate.devices.open("playback:forces.csv:left") as device:
        report = palpate.devices.drive(world, [device], 10.0, session="run.session")   # the engine's own thread
        tip = device.read(); device.write([0.0, 0.0, 0.5])                             # or your own loop, at your own risk

docs/reference/devices.md lists the names and what mends a device that is not there.
"""

from __future__ import annotations

from palpate._core import Device, Loop, drive
from palpate._core import open_device as open  # noqa: A001: palpate.devices.open
from palpate._core import probe_devices as probe
from palpate._core import scripted_device as script

__all__ = ["Device", "Loop", "drive", "open", "probe", "script"]
