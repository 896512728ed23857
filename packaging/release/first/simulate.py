"""The first touch by the command: two seconds of the standard scene, and a hash of every force as the table has it.

  simulate.py PALPATE...     a program, or the words that run it
"""
import csv
import hashlib
import pathlib
import subprocess
import sys
import tempfile

with tempfile.TemporaryDirectory() as folder:
    out = pathlib.Path(folder) / "run"
    subprocess.run([*sys.argv[1:], "simulate", "--seconds", "2", "--no-pictures", "--no-plot", "--out", out], check=True, stdout=sys.stderr)
    with (out / "forces.csv").open(newline="") as table:
        forces = [[row[f"force_{axis}_n"] for axis in "xyz"] for row in csv.DictReader(table)]
most = max(sum(float(value) ** 2 for value in force) ** 0.5 for force in forces)
digest = hashlib.sha256("\n".join(",".join(force) for force in forces).encode()).hexdigest()
print(f"at most {most:.2f} N; hash of {len(forces)} forces {digest[:16]}")
