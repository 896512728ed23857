"""Recorded sessions: reading, replaying and iterating over them.

    with palpate.sessions.Session("run.session") as run:
        felt = run.samples(["tick", "tip", "force"], finger="left")   # dict of arrays
        assert run.replay().identical
    palpate.sessions.repair("torn.session", "mended.session").samples_lost

docs/reference/recordings.md says what is in a file; palpate.devices.Loop and drive record one.
"""

from __future__ import annotations

from palpate._core import ReplayDifference, ReplayReport, Session, SessionBlocks, SessionRepair, repair

__all__ = ["ReplayDifference", "ReplayReport", "Session", "SessionBlocks", "SessionRepair", "repair"]
