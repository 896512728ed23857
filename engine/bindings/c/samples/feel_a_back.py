"""Palpate from Python without any package: ctypes over palpate.h. (`import palpate` is the comfortable way:
docs/reference/python.md.)

    python3 feel_a_back.py [LIBRARY]        left out: libpalpate.so.0, as the loader finds it
"""
import ctypes as c
import sys


class Error(c.Structure):
    _fields_ = [("size", c.c_size_t), ("code", c.c_int32), ("line", c.c_int32), ("message", c.c_char * 512)]


class Place(c.Structure):
    _fields_ = [("size", c.c_size_t), ("point_mm", c.c_double * 3), ("normal", c.c_double * 3), ("triangle", c.c_uint32),
                ("reserved", c.c_uint32), ("name", c.c_char * 128)]


class Touch(c.Structure):  # only its beginning: the library writes no more than `size`
    _fields_ = [("size", c.c_size_t), ("force_n", c.c_double * 3), ("depth_mm", c.c_double), ("touch", c.c_int32),
                ("status", c.c_uint32)]


library = c.CDLL(sys.argv[1] if len(sys.argv) > 1 else "libpalpate.so.0")
library.palpate_version.restype = c.c_char_p
for name in ("palpate_world_release", "palpate_finger_release"):
    getattr(library, name).restype = None
    getattr(library, name).argtypes = [c.c_void_p]
library.palpate_world_torso.argtypes = [c.c_size_t, c.POINTER(c.c_void_p), c.POINTER(Error)]
library.palpate_world_place.argtypes = [c.c_void_p, c.c_char_p, c.POINTER(Place), c.POINTER(Error)]
library.palpate_finger_create.argtypes = [c.c_void_p, c.c_void_p, c.POINTER(c.c_void_p), c.POINTER(Error)]
library.palpate_finger_step.argtypes = [c.c_void_p, c.POINTER(c.c_double), c.POINTER(Touch)]

error = Error(size=c.sizeof(Error))


def checked(code):
    if code != 0:
        raise RuntimeError(error.message.decode())


world, finger, place, touch = c.c_void_p(), c.c_void_p(), Place(size=c.sizeof(Place)), Touch(size=c.sizeof(Touch))
checked(library.palpate_world_torso(0, world, error))
checked(library.palpate_finger_create(world, None, finger, error))
try:
    checked(library.palpate_world_place(world, b"T66", place, error))
except RuntimeError as refused:
    print(refused)
checked(library.palpate_world_place(world, b"T6", place, error))

library.palpate_world_release(world)  # the finger keeps it

tip = (c.c_double * 3)()
for tick in range(501):
    for axis in range(3):
        tip[axis] = place.point_mm[axis] + (2 - 0.02 * tick) * place.normal[axis]
    checked(library.palpate_finger_step(finger, tip, touch))
    if tick % 100 == 0:
        print(f"depth {touch.depth_mm:5.2f} mm  force {sum(f * f for f in touch.force_n) ** 0.5:5.2f} N")
library.palpate_finger_release(finger)
assert abs(touch.depth_mm - 8) < 0.5 and touch.force_n[2] > 1, "the back is felt"
