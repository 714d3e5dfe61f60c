"""Print kernels/sources/simplex_table.clh: the gradients of psrdnoise in three dimensions.

    python3 simplex_table.py > ../../kernels/sources/simplex_table.clh

A hash in [0, 289) chooses a point p on a Fibonacci spiral over the unit sphere and an axis about which it turns; q is p
turned by a right angle, so that the gradient at flow angle a is p cos(a) + q sin(a). The constants are those that
Gustavson and McEwan published, with their digits: a golden angle, 1 - (2 hash + 1) / 289 for the height, and 10 pi / 289.
"""
from math import cos, sin, sqrt

GOLDEN_ANGLE, HEIGHT_STEP, HEIGHT, AXIS_STEP = 3.883222077, -0.006920415, 0.996539792, 0.108705628

HEADER = """\
// Gradients of psrdnoise [Gustavson and McEwan 2021], a row of 8 a hash: p, 0, then q, 0; turned by the angle a the
// gradient is p cos(a) + q sin(a). From a table they keep their digits: cosines of hashes times constants in float lose
// 4e-5. data/make/simplex_table.py prints this file.
#ifndef WR_SOURCES_SIMPLEX_TABLE_CLH
#define WR_SOURCES_SIMPLEX_TABLE_CLH

#include "lanes.clh"

constant WR_SCALAR wr_simplex_gradient[289 * 8] = {"""


def row(hash_value):
    theta, z, psi = hash_value * GOLDEN_ANGLE, hash_value * HEIGHT_STEP + HEIGHT, hash_value * AXIS_STEP
    x, y = cos(theta) * sqrt(1 - z * z), sin(theta) * sqrt(1 - z * z)
    c = sin(theta) * sin(psi) - cos(theta) * cos(psi)
    q = (c * sin(theta) * (1 - z) + sin(psi) * z, -c * cos(theta) * (1 - z) + cos(psi) * z,
         -(y * cos(psi) + x * sin(psi)))
    return x, y, z, 0, *q, 0


print(HEADER)
for h in range(289):
    numbers = [f"WR_R({v:.12f})" if v else "0" for v in row(h)]
    print("    " + ", ".join(numbers[:4]) + ",\n    " + ", ".join(numbers[4:]) + ",")
print("};")
print("\n#endif")
