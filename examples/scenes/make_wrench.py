"""Writes wrench.stl beside itself: an open-end wrench as a closed surface, in millimetres.

The solid is a union of boxes with a square hole through the handle:

    handle      0 <= x <= 120    -6 <= y <=  6    -3 <= z <= 3     hole 6 <= x <= 12, -3 <= y <= 3
    head      120 <= x <= 140   -16 <= y <= 20    -5 <= z <= 5
    jaws      140 <= x <= 160   -16 <= y <= -8    -5 <= z <= 5     (short)
              140 <= x <= 166     8 <= y <= 20    -5 <= z <= 5     (long)

The planes of all boxes cut space into cells. A cell is full or empty, and the surface is every square
between a full and an empty one, so it is closed and no vertex lies within another's edge. All coordinates
are whole numbers, which STL's single precision holds exactly. Same bytes on every machine.
"""

import itertools
import struct
from pathlib import Path

HANDLE = ((0, 120), (-6, 6), (-3, 3))
HOLE = ((6, 12), (-3, 3), (-3, 3))
HEAD = ((120, 140), (-16, 20), (-5, 5))
JAWS = (((140, 160), (-16, -8), (-5, 5)), ((140, 166), (8, 20), (-5, 5)))
BOXES = (HANDLE, HEAD, *JAWS)


def inside(box, point):
    return all(low < x < high for (low, high), x in zip(box, point, strict=False))


def triangles():
    """Triangles of three points, counterclockwise seen from outside."""
    planes = [sorted({x for box in (*BOXES, HOLE) for x in box[axis]}) for axis in range(3)]
    cells = [list(itertools.pairwise(p)) for p in planes]

    def full(i, j, k):
        index = (i, j, k)
        if not all(0 <= n < len(cells[axis]) for axis, n in enumerate(index)):
            return False
        middle = [sum(cells[axis][n]) / 2 for axis, n in enumerate(index)]
        return any(inside(box, middle) for box in BOXES) and not inside(HOLE, middle)

    for index in itertools.product(*(range(len(c)) for c in cells)):
        if not full(*index):
            continue
        corner = [cells[axis][n] for axis, n in enumerate(index)]
        for axis, side in itertools.product(range(3), (0, 1)):
            beyond = list(index)
            beyond[axis] += 1 if side else -1
            if full(*beyond):
                continue
            # the square's corners, counterclockwise seen from where the axis points to
            u, v = (axis + 1) % 3, (axis + 2) % 3
            square = []
            for at_u, at_v in ((0, 0), (1, 0), (1, 1), (0, 1)):
                point = [0, 0, 0]
                point[axis], point[u], point[v] = corner[axis][side], corner[u][at_u], corner[v][at_v]
                square.append(tuple(point))
            if side == 0:
                square.reverse()
            normal = tuple((1 if side else -1) if a == axis else 0 for a in range(3))
            a, b, c, d = square
            yield normal, (a, b, c)
            yield normal, (a, c, d)


def main():
    surface = list(triangles())
    data = b"bryla: open-end wrench, millimetres".ljust(80) + struct.pack("<I", len(surface))
    for normal, corners in surface:
        data += struct.pack("<12fH", *normal, *itertools.chain(*corners), 0)
    Path(__file__).with_name("wrench.stl").write_bytes(data)


if __name__ == "__main__":
    main()
