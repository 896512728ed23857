"""The ideal observer, by a finer rule than the product and by bisection."""
import math


def below(x):
    return 0.5 * math.erfc(-x / math.sqrt(2))


def ideal_right(d, choices):
    step = 0.05
    return sum(step * math.exp(-0.5 * x * x) / math.sqrt(2 * math.pi) * below(d + x) ** (choices - 1)
               for x in (-9 + step * i for i in range(361)))


def d_prime(share, choices):
    wanted = 1 / choices + (1 - 1 / choices) * share
    low, high = 0.0, 8.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if ideal_right(middle, choices) < wanted else (low, middle)
    return 0.5 * (low + high)


IDEAL = {}


def ideal(choices):
    """d' at the threshold, and the slope."""
    if choices not in IDEAL:
        quarter, half, most = (d_prime(s, choices) for s in (0.25, 0.5, 0.75))
        IDEAL[choices] = half, math.log(math.log(4) / math.log(4 / 3)) / math.log(most / quarter)
    return IDEAL[choices]
