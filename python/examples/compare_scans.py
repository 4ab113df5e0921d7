#!/usr/bin/env python3
"""Two scans laid onto each other; a picture where matplotlib is installed.

Usage: compare_scans.py TARGET SOURCE [PICTURE.png]
"""

import sys

import numpy as np

import morsel

target, source = (morsel.segment(morsel.read_points(path)) for path in sys.argv[1:3])
found = morsel.match(target, source)
print(f"score {found.score:.2f}{', mirrored' if found.mirrored else ''}")
for pair in found.correspondences:
    print(f"part {pair.source} lies on part {pair.target}: {pair.contribution:.0%} of the overlap")

moved = found.apply(source.points)
print(f"scaled by {np.cbrt(abs(np.linalg.det(found.target_from_source[:3, :3]))):.3g}")

if len(sys.argv) > 3:
    try:
        import matplotlib
    except ImportError:
        sys.exit("no picture: matplotlib is not installed")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    # Parts of the source in the colours of the parts of the target that they lie on.
    partner = {pair.source: pair.target for pair in found.correspondences}
    colors = [partner.get(label, -1) for label in source.labels.tolist()]
    axes = pyplot.figure(figsize=(8, 4)).subplots(1, 2, subplot_kw={"projection": "3d"})
    for view, points, parts in zip(axes, (target.points, moved), (target.labels, colors)):
        view.scatter(*points.T, c=parts, s=1, cmap="tab10", vmin=-1, vmax=8)
        view.set_box_aspect(np.ptp(points, axis=0))
    pyplot.savefig(sys.argv[3])
