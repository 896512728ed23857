"""Scenes of strangers against the hand that holds the device."""
import json
import math
import socket
import time

from lab import Mend, attack, judged

WEAKEST_N = 3.3  # of the known devices

SCENE = """title = "wish"
[body]
kind = "torso"
[tissue]
force_law = "linear"
[deformation]
tissue = "gaussian"
[stiffness]
source = "constant"
constant_n_per_mm = 5.0
[safety]
%s
stiffness_cap_n_per_mm = 5
nominal_force_n = 100
delay_ticks = %d
[[finger]]
name = "a"
radius_mm = 8
at = "T6"
script = [{ do = "press", depth_mm = 6, seconds = 3 }]
"""

CAP = Mend("engine/core/palpate/servo/device_limits.cpp", "return safety.unsafe_stiffness ? asked : std::min(cap, asked);",
           "return asked;")
FORCE = Mend("engine/core/palpate/device/device_profile.cpp",
             "return std::min(safety.nominal_force_n, safety.unsafe_stiffness ? profile.unsafe_force_n : profile.force_n);",
             "return safety.nominal_force_n;")


@attack("wish_past_the_cap", "loop", [CAP, FORCE], seconds=20.0)
def wish_past_the_cap(lab):
    """A scene asks for 5 N/mm and 100 N on an unknown device whose loop is stable up to 0.67 N/mm."""
    (lab.folder / "scene.toml").write_text(SCENE % ("", 3))
    result = lab.run("simulate", "scene.toml", "--no-pictures", "--no-plot", "--json", "--seconds", "0.5", seconds=15.0)
    report = json.loads(result.stdout)
    factor, force = report["device"]["stiffness_factor"], report["device"]["force_n"]
    noted = [note for note in report["notes"] if "stiffness_cap_n_per_mm" in note]
    return judged(factor < 0.137 and force <= WEAKEST_N and noted,
                  f"factor {factor:.3f}, at most {force:.1f} N, {len(noted)} note")


def strongest_answer(client, address, process, seconds):
    """Presses 40 mm into the body once the first answer has come; the longest force that came back, N."""
    first, strongest, end = None, 0.0, time.monotonic() + seconds
    while time.monotonic() < end and process.poll() is None:
        since = 0.0 if first is None else time.monotonic() - first
        client.sendto(b"p 0 0 %.3f" % (-40.0 * min(1.0, since / 0.8)), address)
        try:
            while True:
                words = client.recv(256).split()
                if words and words[0] == b"f":
                    first = first or time.monotonic()
                    strongest = max(strongest, math.hypot(*(float(word) for word in words[1:4])))
        except (BlockingIOError, ConnectionError):
            time.sleep(0.001)
    return strongest


@attack("stronger_device_by_name", "loop", [
    Mend("engine/core/palpate/device/device_profile.cpp",
         "DeviceProfile profile = profileOf(recognised || reported.takes_force ? reported.kind : named);",
         "DeviceProfile profile = profileOf(recognised ? reported.kind : named);")], seconds=40.0)
def stronger_device_by_name(lab):
    """A scene names the strongest device; what opens is an unknown one, by datagrams."""
    (lab.folder / "scene.toml").write_text(SCENE % ('device = "premium_3_0"', 1))
    port = lab.free_port(socket.SOCK_DGRAM)
    process = lab.start(lab.palpate, "simulate", "scene.toml", "--no-pictures", "--no-plot", "--realtime",
                        "--device", f"remote:{port}", "--seconds", "3")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as client:
        client.setblocking(False)
        strongest = strongest_answer(client, ("127.0.0.1", port), process, 25.0)
    return judged(0.5 < strongest <= WEAKEST_N * 1.0001, f"pressed 40 mm deep, at most {strongest:.2f} N came back")
