#!/usr/bin/env python3
"""The parts of a scan as a table, and as a page for the browser.

Usage: parts_of_a_scan.py SCAN [PAGE.html]
"""

import sys

import morsel

points = morsel.read_points(sys.argv[1])
shape = morsel.segment(points)
print(shape.message)
if not shape.is_solid:
    sys.exit(1)

for part in shape.parts:
    beside = ", ".join(str(neighbour.part) for neighbour in part.neighbours)
    print(f"part {part.number}: {part.point_count} points, volume {part.volume:.3g}, "
          f"thickness {2 * part.radius:.3g}, beside {beside or 'nothing'}")

# Another cut costs nothing; a number that lasts over a wide range of ratios is the shape's own.
for level in shape.levels[:5]:
    x, y, z = shape.cut(parts=level.parts).parts[0].center
    print(f"cut in {level.parts}, the largest part is around ({x:.3g}, {y:.3g}, {z:.3g})")

if len(sys.argv) > 2:
    shape.write_html(sys.argv[2], name=sys.argv[1])
