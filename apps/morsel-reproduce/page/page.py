#!/usr/bin/env python3
"""Makes one self-contained page of what morsel-reproduce wrote.

Usage: page.py FOLDER [--docs DIR]

Reads FOLDER/figures.json and FOLDER/pictures, writes FOLDER/index.html, which loads nothing. With
--docs also the small form that is kept in the repository: figures.json, README.md, a few pictures.
"""

import argparse
import base64
import html
import json
import pathlib
import shutil
from math import log
from statistics import median

import charts

HERE = pathlib.Path(__file__).resolve().parent
WAYS = {"paper": "paper's rules", "default": "morsel"}


class Page:
    """Pieces of HTML, and the pictures that go into them."""

    def __init__(self, folder):
        self.folder = folder
        self.figures = json.loads((folder / "figures.json").read_text(encoding="utf-8"))
        self.pieces = []

    def add(self, text):
        self.pieces.append(text)

    def heading(self, anchor, text):
        self.add(f'<h2 id="{anchor}">{text}</h2>')

    def image(self, path, alt):
        data = (self.folder / path).read_bytes()
        kind = "svg+xml" if path.endswith(".svg") else "png"
        code = base64.b64encode(data).decode()
        return f'<img src="data:image/{kind};base64,{code}" alt="{html.escape(alt)}" loading="lazy">'

    def cell(self, path, alt, text):
        return f'<div class="cell">{self.image(path, alt)}<span>{text}</span></div>'


def percent(value):
    return f"{100 * value:.3g}%"


def seconds(value):
    """Three figures in a unit that reads well."""
    if value < 1e-3:
        return f"{1e6 * value:.3g} µs"
    return f"{1e3 * value:.3g} ms" if value < 1 else f"{value:.3g} s"


def times(value):
    """A factor, rounded so that it does not promise what it cannot keep."""
    return f"{float(f'{value:.2g}'):,.0f}×"


def table(heads, rows, marked=()):
    head = "".join(f"<th>{h}</th>" for h in heads)
    body = "".join(f'<tr{" class=ours" if i in marked else ""}>' + "".join(f"<td>{c}</td>" for c in row) + "</tr>"
                   for i, row in enumerate(rows))
    return f'<div class="scroll"><table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>'


def verdict(good, text):
    return f'<p class="verdict{"" if good else " no"}">{text}</p>'


def growth(rows, key):
    """The exponent of time over points, by least squares of the logarithms."""
    xs, ys = [log(r["points"]) for r in rows], [log(r[key]) for r in rows]
    mx, my = sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((x - mx) * (y - my) for x, y in zip(xs, ys)) / sum((x - mx) ** 2 for x in xs)


def scoring(rows, name):
    return next(row for row in rows if row["name"] == name)


def is_complete(figures):
    """Whether the run came to its end: the last of the claims is there."""
    return "open" in figures.get("claims", {})


def add_opening(page):
    f = page.figures
    rows = f["times"]["rows"]
    ours = scoring(f["retrieval"]["generated"]["matrix"]["scorings"], "morsel")
    tiles = [(seconds(rows[-1]["seconds"]), f'from {rows[-1]["points"]:,} points to parts on {f["cores"]} cores; '
              f'the paper, in 2004: {rows[-1]["paper_seconds"]:,.0f} s'),
             (percent(ours["nearest_neighbor"]), f'of {len(f["retrieval"]["generated"]["matrix"]["categories"])} shapes have '
              "one of their own class as nearest neighbour")]
    if is_complete(f):
        curves = f["claims"]["curves"]["noise"]
        clean, some = curves[0], min(curves, key=lambda c: abs(c["noise"] - 0.005))
        query = max((q for q in f["claims"]["queries"] if q["method"] == "default"), key=lambda q: q["signatures"])
        tiles[1:1] = [(f'{some["default"]:.3f}', f'Rand error at noise of {percent(some["noise"])} on figures whose true parts '
                       f'are known (clean {clean["default"]:.3f}; the published rules to the letter {some["paper"]:.3f})')]
        tiles.append((seconds(query["median_seconds"]), f'for the five best of {query["signatures"]:,} signatures, exactly'))
    page.add("<h1>Parts, signatures and look-alikes from noisy points</h1>")
    page.add('<p class="lead">morsel takes the point cloud of a solid object, noisy or clean, and says which points '
             "belong to which part; what it finds makes a signature of at most one kilobyte, by which shapes of the same "
             "kind find each other in any pose and scale. Points are enough: no mesh, no normals, no training, nothing "
             "to tune.</p>")
    shapes = f["parts"]["shapes"]
    shown = next((s for s in shapes if s["name"] == "triceratops"), shapes[0])["runs"]
    shown = [r for r in shown if r["method"] == "default"]
    page.add('<figure><div class="grid three">' + "".join(
        page.cell(r["picture"], "parts in colours", f'{r["points"]:,} points, noise {percent(r["noise"])}: '
                  f'<b>{r["parts"]} parts</b>') for r in shown) +
             "</div><figcaption>Noise is Gaussian in all directions, its standard deviation a fraction of the "
             "bounding-box diagonal. A colour stands for a part.</figcaption></figure>")
    page.add('<div class="tiles">' + "".join(f"<div class=tile><b>{b}</b><span>{t}</span></div>" for b, t in tiles) + "</div>")
    page.add("<pre>make demo                                      # parts of example scans\n"
             "morsel segment scan.ply --html parts.html      # turn the parts and cut them finer\n"
             "morsel index --database shapes.db models/      # store the shapes of a folder\n"
             "morsel search --database shapes.db scan.ply    # those most like a scan</pre>")
    page.add("<p>The rest of this page is the evidence. It follows the paper on which morsel builds, T. K. Dey, J. Giesen "
             "and S. Goswami, <i>Shape Segmentation and Matching from Noisy Point Clouds</i> (Symposium on Point-Based "
             "Graphics, 2004), figure by figure and claim by claim, with that method taken literally "
             "(<code>--method paper</code>) beside morsel's default. Every picture and number was made by one run of "
             "<code>make reproduce</code>; no shape had settings of its own.</p>")
    page.add('<nav><ul><li><a href="#plane">Figures 1 and 2: the steps, in the plane</a></li>'
             '<li><a href="#parts">Figure 3: parts under noise</a></li><li><a href="#balls">Figure 4: representative points</a></li>'
             '<li><a href="#queries">Figure 5: queries</a></li><li><a href="#times">Times</a></li>'
             '<li><a href="#matrix">Figure 6: similarity matrix</a></li><li><a href="#d2">Figure 7: against D2</a></li>'
             '<li><a href="#claims">The paper\'s claims, measured</a></li></ul></nav>')


def add_plane(page):
    p = page.figures["plane"]
    page.heading("plane", "Figures 1 and 2: the steps, in the plane")
    page.add(f'<p>The rules of the paper, run one dimension lower: CGAL\'s Delaunay triangulation of {p["points"]} points '
             f'scattered around an outline, and everything else read off it. {p["small_balls"]:,} of {p["triangles"]:,} '
             f'balls are small (radius at most {p["rho"]:g} λ); a walk from outside through big balls that meet at less '
             f'than {p["deep_angle"]:g}° leaves {p["inner"]} inner triangles with {p["maxima"]} maxima of the distance to the '
             f'points, and merging at the ratio {p["merge_ratio"]:g} leaves {p["parts"]} parts.</p>')
    captions = ("<b>1.</b> Delaunay triangulation", "<b>2.</b> All balls; small ones orange",
                "<b>3.</b> Union of the inner big balls", "<b>4.</b> Inner triangles; those that hold maxima dark",
                "<b>5.</b> Basins: what flows to each maximum", "<b>6.</b> Parts: basins merged")
    page.add('<figure><div class="grid three">' + "".join(page.cell(s, c, c) for s, c in zip(p["steps"], captions)) +
             '</div><figcaption><b>Figure 1.</b> Computed, not drawn. ρ is larger than the published 0.5, which sets no '
             "ball apart on points this noisy.</figcaption></figure>")
    s = p["saddle"]
    page.add(f'<figure style="max-width:640px">{page.image(s["picture"], "a saddle between two maxima")}<figcaption>'
             "<b>Figure 2.</b> A saddle (orange dot) and its stable manifold, the edge through it, which separates two "
             f'maxima (blue dots). From the saddle, where the distance to the points is {s["radius"]:.3f}, the flow climbs '
             f'over larger and larger balls (blue lines) to {s["maxima"][0]:.3f} on one side and {s["maxima"][1]:.3f} '
             f'on the other. {s["points"]} noisy points around two disks that overlap; the clearest saddle of all, found by the '
             "program.</figcaption></figure>")


def add_parts(page):
    shapes = page.figures["parts"]["shapes"]
    page.heading("parts", "Figure 3: parts under noise")
    runs = [r for s in shapes for r in s["runs"]]
    solid = {w: sum(r["method"] == w and r["verdict"] == "solid" for r in runs) for w in WAYS}
    parts = {w: median([r["parts"] for r in runs if r["method"] == w and r["verdict"] == "solid"]) for w in WAYS}
    page.add(f'<p>{len(shapes)} shapes, each clean and with noise of 0.3% and 0.5% of the diagonal, by the published rules '
             "(ρ = 0.5, merge ratio 1.5; the angle, which the paper does not give, 10° as in a later program of one of its "
             "authors) and by morsel's default. <i>Volume</i> is the inside's, relative to that of morsel on the clean cloud: "
             "where it is far above 100%, the walk from outside did not reach all that is outside. Grey points have no "
             "part.</p>")
    page.add(verdict(parts["paper"] <= 2 * parts["default"],
                     f'The published rules find an inside in {solid["paper"]} of {len(runs) // 2} clouds, morsel in '
                     f'{solid["default"]}; the median cloud falls into {parts["paper"]:g} parts by the rules and into '
                     f'{parts["default"]:g} by morsel. Most of the former are crumbs within the noise, and one part swallows the rest.'))
    for shape in shapes:
        reference = next((r["volume"] for r in shape["runs"] if r["method"] == "default" and r["noise"] == 0), 0)
        cells = []
        for run in shape["runs"]:
            text = f'{WAYS[run["method"]]}, noise {percent(run["noise"])}<br>'
            if run["verdict"] == "solid":
                volume = f', volume {percent(run["volume"] / reference)}' if reference else ""
                text += f'<b>{run["parts"]} parts</b>{volume}'
            else:
                text += '<b class="bad">no solid found</b>'
            cells.append(page.cell(run["picture"], f'{shape["name"]}, {WAYS[run["method"]]}', text))
        page.add(f'<div class="shape"><h4>{html.escape(shape["name"])} <span class="soft">· {html.escape(shape["source"])}, '
                 f'{shape["runs"][0]["points"]:,} points</span></h4><div class="grid six">{"".join(cells)}</div></div>')
    page.heading("balls", "Figure 4: representative points")
    page.add("<p>Each part as a ball at its centre of mass that grows with its volume: what the paper's signature keeps of a "
             "shape.</p>")
    cells = [page.cell(r["balls"], "balls", f'{html.escape(s["name"])}: <b>{r["parts"]}</b>')
             for s in shapes for r in s["runs"] if "balls" in r and r["verdict"] == "solid"]
    page.add(f'<figure><div class="grid four">{"".join(cells)}</div><figcaption><b>Figure 4.</b> Volumes of the balls are '
             "those of the parts times 0.42, so that neighbours do not hide each other. Default method, clean points.</figcaption></figure>")


NAMES = {"generated": "generated shapes", "psb": "Princeton Shape Benchmark"}


def collections(page):
    return [(k, page.figures["retrieval"][k]) for k in NAMES if k in page.figures["retrieval"]]


def add_queries(page):
    page.heading("queries", "Figure 5: queries")
    page.add("<p>A query (left) and the five shapes of the highest scores, each turned by the alignment that the match returns, "
             "parts that lie on each other in one colour. All shapes were stored in random poses, scales and mirrorings. "
             "A score is 1 for the shape itself.</p>")
    for key, data in collections(page):
        page.add(f"<h3>{NAMES[key]}</h3>")
        for row in data["queries"]:
            cells = [page.cell(row["picture"], "query", f'query<br><b>{html.escape(row["name"])}</b>')]
            for hit in row["hits"]:
                mark = "good" if hit["same"] else "bad"
                cells.append(page.cell(hit["picture"], hit["name"], f'<b>{hit["score"]:.2f}</b><br><span class="{mark}">'
                                       f'{html.escape(hit["name"])}{"" if hit["same"] else ", " + html.escape(hit["category"])}</span>'))
            page.add(f'<div class="shape"><div class="grid six">{"".join(cells)}</div></div>')


def add_times(page):
    rows = page.figures["times"]["rows"]
    page.heading("times", "Times")
    page.add(f'<p>From points to parts. The paper\'s figures are of a 2.8 GHz Pentium 4 of 2004, ours of this machine '
             f'({html.escape(page.figures["processor"])}, {page.figures["cores"]} cores), median of {page.figures["times"]["runs"]}: '
             "the factor is due to twenty years of machines and to the program alike. Shapes are not the paper's, the numbers of "
             "points are.</p>")
    page.add(table(("points", "paper's shape", "paper", "ours", "morsel", "factor", "one thread", "paper's rules in morsel"),
                   [(f'{r["points"]:,}', r["paper_shape"], f'{r["paper_seconds"]:,.4g} s', pathlib.PurePath(r["shape"]).stem,
                     seconds(r["seconds"]), times(r["factor"]), seconds(r["one_thread_seconds"]),
                     seconds(r["paper_rules_seconds"])) for r in rows]))
    old = growth([{"points": r["points"], "seconds": r["paper_seconds"]} for r in rows], "seconds")
    new = growth(rows, "one_thread_seconds")
    page.add('<figure style="max-width:620px">' + charts.line_chart(
        [("paper", [(r["points"], r["paper_seconds"]) for r in rows]),
         ("morsel, all cores", [(r["points"], r["seconds"]) for r in rows]),
         ("morsel, one thread", [(r["points"], r["one_thread_seconds"]) for r in rows])],
        "points", "seconds", log=True) +
             f"<figcaption>Time grows as about n<sup>{old:.1f}</sup> in the paper and n<sup>{new:.1f}</sup> here (one "
             "thread).</figcaption></figure>")


def add_matrix(page):
    page.heading("matrix", "Figure 6: the similarity matrix")
    for key, data in collections(page):
        m = data["matrix"]
        classes = len(set(m["categories"]))
        page.add(f'<h3>{NAMES[key]}: {len(m["categories"])} shapes in {classes} classes</h3>')
        if key == "generated":
            page.add("<p>Made by our own generator, so that anybody can run this: seventeen families of solids, varied in "
                     "proportions and pose, sampled with noise of 0.2%, stored in random poses. They vary less within a "
                     "class than real models do: take the comparison, not the level.</p>")
        for name, label in (("morsel", "morsel's default score"), ("paper's score and parts", "the paper's score of the paper's parts"),
                            ("D2", "D2")):
            row = scoring(m["scorings"], name)
            page.add(f'<figure style="max-width:860px"><figcaption><b>{label}.</b> The five best of each row: '
                     '<span style="color:var(--s1)">■</span> same class, <span style="color:var(--s2)">■</span> another.</figcaption>'
                     + charts.matrix(m["categories"], row["best"]) + "</figure>")
        page.add(table(("score", "nearest neighbour", "first tier", "second tier", "DCG"),
                       [(r["name"],) + tuple(f"{r[k]:.3f}" for k in ("nearest_neighbor", "first_tier", "second_tier", "discounted_gain"))
                        for r in m["scorings"]], marked=(0,)))
        page.add('<p class="note">“Paper\'s score, our parts”: section 4 of the paper over the parts of the default method, with the '
                 "free roll and the scaling solved (docs/signature.md); “score and parts”: over the parts of the published "
                 "rules; “to the letter”: with axis-parallel boxes and the roll left as it is.</p>")


def add_d2(page):
    page.heading("d2", "Figure 7: against the D2 shape distribution")
    page.add("<p>D2 is the histogram of distances between random pairs of points. Of all triples of a query, a shape of its class "
             "and one of another, a program looked for the case that D2 has wrong and the part-based score right most clearly; "
             "the table counts the opposite as well.</p>")
    for key, data in collections(page):
        page.add(f"<h3>{NAMES[key]}</h3>")
        counts = data["d2"]["counts"]
        if "case" in data["d2"]:
            case = data["d2"]["case"]
            query, same, other = case["query"], case["same"], case["other"]
            page.add(f'<p>D2 puts {html.escape(query["name"])} ({html.escape(query["category"])}) at '
                     f'{other["d2_distance"]:.3f} from {html.escape(other["name"])} ({html.escape(other["category"])}) and at '
                     f'{same["d2_distance"]:.3f} from {html.escape(same["name"])}, of its own class. '
                     f'morsel scores them {other["score"]:.2f} and {same["score"]:.2f}.</p>')
            cells = [page.cell(c["picture"], c["name"], f'{html.escape(c["name"])}: {t}') for c, t in
                     ((query, "query"), (same, "same class"), (other, "another class"))]
            page.add(f'<figure><div class="grid three">{"".join(cells)}</div></figure><div class="grid two">')
            for member, text in ((same, "same class"), (other, "another class")):
                bins = range(len(query["d2"]))
                lines = [(html.escape(c["name"]), [(3 * b / len(query["d2"]), c["d2"][b]) for b in bins]) for c in (query, member)]
                page.add("<figure>" + charts.line_chart(lines, "distance over the mean distance", f"D2: share of pairs, {text}") +
                         f'<div style="max-width:340px;margin-top:14px">{page.image(member["balls"], "aligned signatures")}</div>'
                         f'<figcaption>The query\'s weighted points (colours) and those of the {text}, aligned (dashed).</figcaption></figure>')
            page.add("</div>")
        page.add(table(("triples", "both right", "only D2 wrong", "only the score wrong", "both wrong"),
                       [(c["name"], *(f"{c[k]:,}" for k in ("both_right", "only_d2_wrong", "only_parts_wrong", "both_wrong")))
                        for c in counts], marked=(0,)))
        worse = [c["name"] for c in counts if c["only_parts_wrong"] > c["only_d2_wrong"]]
        if worse:
            page.add(verdict(False, f'Against D2, more triples are lost than won here by: {"; ".join(worse)}.'))


def retrieval_lines(rows, x, names, key):
    return [(name, [(r[x], scoring(r["retrieval"], name)[key]) for r in rows]) for name in names]


def add_robustness(page, c):
    page.add("<h3>Robust to noise</h3>")
    noise, outliers = c["curves"]["noise"], c["curves"]["outliers"]
    last = min(noise, key=lambda r: abs(r["noise"] - 0.01))
    page.add(f'<p>{noise[0]["shapes"]} generated figures sampled anew in new poses, Rand error against their true parts; '
             "then as noisy queries among the stored shapes.</p>")
    names = ["morsel", "paper's score, our parts", "paper's score and parts", "paper, to the letter", "D2"]
    for rows, x, label in ((noise, "noise", "noise, of the diagonal"), (outliers, "outliers", "outliers, of the points")):
        top = max(max(r["default"], r["paper"]) for r in rows) * 1.1
        page.add('<div class="grid two"><figure>' + charts.line_chart(
            [("morsel", [(r[x], r["default"]) for r in rows]), ("paper's rules", [(r[x], r["paper"]) for r in rows])],
            label, "Rand error: lower is better", y_high=top, percent_x=True) + "</figure><figure>" +
                 charts.line_chart(retrieval_lines(rows, x, names, "discounted_gain"), label,
                                   "discounted cumulative gain: higher is better", y_high=1.0, percent_x=True) + "</figure></div>")
    worst = max(outliers, key=lambda r: r["outliers"])
    delivers = noise[0]["paper"] < 1.5 * noise[0]["default"] and last["paper"] < 1.5 * last["default"]
    page.add(verdict(delivers, ("The published rules, taken literally, hold up: " if delivers else
                                "Taken literally, the published rules do not deliver, with noise or without: ") +
                     f'Rand error {noise[0]["paper"]:.3f} on clean points and {last["paper"]:.3f} at noise of '
                     f'{percent(last["noise"])}, with an inside found in {noise[0]["paper_solid"]} and {last["paper_solid"]} of '
                     f'{noise[0]["shapes"]} figures. morsel\'s default has {noise[0]["default"]:.3f} and {last["default"]:.3f}, and with '
                     f'{percent(worst["outliers"])} of outliers {worst["default"]:.3f}.'))
    if "annotated" in page.figures:
        a = page.figures["annotated"]
        page.add(f'<p>The same on {a["models"]} meshes that people have cut (Princeton Segmentation Benchmark, {a["points"]:,} points):</p>')
        page.add('<div class="grid two">' + "".join("<figure>" + charts.line_chart(
            [("morsel", [(r[x], r["default"]) for r in a[x]]), ("paper's rules", [(r[x], r["paper"]) for r in a[x]])], label,
            "Rand error against people", percent_x=True) + "</figure>" for x, label in
            (("noise", "noise, of the diagonal"), ("outliers", "outliers, of the points"))) + "</div>")


def add_parameters(page, c):
    p = c["parameters"]
    page.add("<h3>ρ = 0.5 and a merge ratio of 1.5</h3>")
    rho = [(f'balls meet deeply below {curve["angle"]:g}°', [(v["rho"], v["error"]) for v in curve["values"]]) for curve in p["rho"]]
    merge = [({"paper": "paper's rules", "default": "morsel"}[m["name"]], [(v["ratio"], v["error"]) for v in m["values"]])
             for m in p["merge"]]
    top = max(y for _, line in rho + merge for _, y in line) * 1.1
    page.add('<div class="grid two"><figure>' + charts.line_chart(rho, "ρ, above which a ball is big", "Rand error, paper's rules", y_high=top) +
             "</figure><figure>" + charts.line_chart(merge, "merge ratio", "Rand error", y_high=top) + "</figure></div>")
    best_rho = min(((v["error"], v["rho"], curve["angle"], v["solid"]) for curve in p["rho"] for v in curve["values"]))
    at_half = [next(v for v in curve["values"] if v["rho"] == 0.5) for curve in p["rho"]]
    rules = next(m for m in p["merge"] if m["name"] == "paper")["values"]
    at_paper = min(rules, key=lambda v: abs(v["ratio"] - 1.5))
    best_ratio = min(rules, key=lambda v: v["error"])
    page.add(verdict(False, f'With ρ = 0.5 the rules find an inside in {", ".join(str(v["solid"]) for v in at_half)} of {p["shapes"]} figures '
                     f'for the angles {", ".join(f"""{curve["angle"]:g}°""" for curve in p["rho"])}; their best is ρ = {best_rho[1]:g} at '
                     f'{best_rho[2]:g}° (Rand error {best_rho[0]:.3f}). Of the merge ratios {best_ratio["ratio"]:g} serves them best '
                     f'({best_ratio["error"]:.3f}; 1.5: {at_paper["error"]:.3f}). morsel asks for neither number: {p["default"]:.3f} '
                     "with the same defaults for every shape."))


def add_invariance(page, c):
    i = c["invariance"]
    page.add("<h3>Invariant to rotation, translation, mirroring and scaling</h3>")
    page.add(table((f'largest deviation over {i["transforms"]:,} random transforms of {i["shapes"]} shapes', ""),
                   [("morsel's score from 1", f'{i["score"]:.3g}'), ("paper's score from 1, roll and scaling solved", f'{i["paper_score"]:.3g}'),
                    ("paper's score from 1, to the letter", f'{i["literal_score"]:.3g}'),
                    ("a byte of the signature's tables, of 255", i["table_step"]),
                    ("Rand error between the labels before and after", f'{i["labels"]:.3g}')]))
    page.add(verdict(i["score"] < 0.02, f'{i["same_tables"]:,} of {i["transforms"]:,} transforms left every byte of the tables as it was, '
                     f'{i["same_labels"]:,} every label. Rounding moves the coordinates of the others: where cells or merges of noisy points are equal but for that, another '
                     "comes first, on small clouds with many parts to choose from. The paper's score to the letter is not invariant: boxes along the axes change with the "
                     "pose, and the roll about the aligned line is left free."))


def add_claims(page):
    c = page.figures["claims"]
    page.heading("claims", "The paper's claims, measured")
    r, s, d = c["repeatability"], c["sizes"], c["points"]
    page.add("<h3>Simple, combinatorial, one data structure</h3>")
    page.add(verdict(r["same"] == r["shapes"], f'Holds. Everything is read off one Delaunay triangulation by exact predicates. Of {r["shapes"]} '
                     f'shapes, {r["same"]} got exactly the same labels with their points in reverse order and on all cores as in order and on one.'))
    page.add("<p>What does not hold is that a few numbers decide inside and outside. morsel's default keeps the triangulation, the flow and its "
             "basins, and replaces those rules: it smooths noise first, seeds and floods inside and outside, and merges by "
             "necks, lines of sight and size (docs/method.md).</p>")
    add_robustness(page, c)
    add_parameters(page, c)
    add_invariance(page, c)
    page.add("<h3>A query takes less than a second</h3>")
    page.add(table(("score", "signatures", "median", "worst"), [(WAYS[q["method"]] if q["method"] == "default" else "paper's score", f'{q["signatures"]:,}',
                   seconds(q["median_seconds"]), seconds(q["worst_seconds"])) for q in c["queries"]]))
    page.add(verdict(all(q["worst_seconds"] < 1 for q in c["queries"]),
                     ("Holds" if all(q["worst_seconds"] < 1 for q in c["queries"]) else "Does not hold everywhere") +
                     ": five best, every answer that of scoring all. The larger sets are variations of the generated signatures."))
    page.add("<h3>Under ten points are enough</h3>")
    names = [row["name"] for row in d[0]["scorings"]]
    page.add('<figure style="max-width:620px">' + charts.line_chart(
        [(n, [(p["points"], scoring(p["scorings"], n)["discounted_gain"]) for p in d]) for n in names],
        "weighted points kept, heaviest first", "discounted cumulative gain", y_high=1.0) + "</figure>")
    ours = scoring(page.figures["retrieval"]["generated"]["matrix"]["scorings"], "morsel")["discounted_gain"]
    last = scoring(d[-1]["scorings"], "paper's score, our parts")["discounted_gain"]
    best = max(d, key=lambda p: scoring(p["scorings"], "paper's score, our parts")["discounted_gain"])
    page.add(verdict(False, f'Enough for the score that is made of them, which is best with {best["points"]}; but that score stops at {last:.3f}, and '
                     f'morsel\'s, which reads {s["bytes"]:,.0f} bytes of statistics beside the points, reaches {ours:.3f}. Signatures have '
                     f'{s["default_parts"]:g} parts (median; the figures have {s["true_parts"]:g}, the published rules find {s["paper_parts"]:g}).'))
    page.add("<h3>Growth of time</h3>")
    page.add(f'<p>See <a href="#times">Times</a>: about n<sup>{growth(page.figures["times"]["rows"], "one_thread_seconds"):.1f}</sup> '
             "over six different shapes, where the paper reports n<sup>1.8</sup>.</p>")
    add_limits(page, c)


def add_limits(page, c):
    page.add("<h3>Volumes only, no boundaries</h3>")
    if c["open"]:
        def says(o, way):
            return f'{o[way + "_parts"]} parts' if o[way] == "solid" else "no solid found"
        page.add(table(("surface", "openings found", "morsel", "paper's rules", "their volume"),
                       [(html.escape(o["file"]), o["openings"], says(o, "default"), says(o, "paper"),
                         percent(o["paper_volume"]) if o["default"] == o["paper"] == "solid" else "–") for o in c["open"]]))
        page.add("<p>The paper excludes surfaces with boundary. morsel closes openings that are small against what lies behind them and refuses what "
                 "encloses nothing, such as hippo1.ply, scanned from one side.</p>")
    else:
        page.add("<p>Not measured: the open example scans were not at hand.</p>")
    p = c["poses"]
    page.add("<h3>No deformation</h3>")
    page.add(table((f'{p["pairs"]} figures with joints', "the same figure in another pose", "another figure of its class"),
                   [(s["name"], f'{s["same_figure"]:.3f}', f'{s["same_class"]:.3f}') for s in p["scores"]]))
    page.add(f'<p>As the paper says: the segmentation is as right in one pose as in the other (Rand error {p["error"][0]:.3f} and '
             f'{p["error"][1]:.3f}), but neither score compensates for the pose: the same figure with bent limbs scores well below 1, '
             "if above others of its class.</p>")


def write_page(page):
    add_opening(page)
    add_plane(page)
    add_parts(page)
    add_queries(page)
    add_times(page)
    add_matrix(page)
    add_d2(page)
    if is_complete(page.figures):
        add_claims(page)
    else:
        page.heading("claims", "The paper's claims")
        page.add("<p>Not measured: the run was ended before.</p>")
    f = page.figures
    page.add(f'<footer>morsel {f["version"]}, {f["date"]}, {html.escape(f["processor"])}, {f["cores"]} cores'
             f'{", quick run: little of everything" if f["quick"] else ""}. Meshes and clouds: Debian\'s libcgal-demo. '
             "Made by <code>make reproduce</code>.</footer>")
    style = (HERE / "style.css").read_text(encoding="utf-8")
    (page.folder / "index.html").write_text(
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        "<title>morsel: the paper, reproduced and answered</title>"
        f'<style>{style}</style></head><body><main>{"".join(page.pieces)}</main></body></html>\n', encoding="utf-8")


def small_form(value):
    """The figures without what only the page needs: pictures, rankings, histograms."""
    if isinstance(value, dict):
        return {k: small_form(v) for k, v in value.items()
                if k not in ("picture", "balls", "steps", "best", "categories") and not is_histogram(v)}
    if isinstance(value, list):
        return [small_form(v) for v in value]
    return round(value, 5) if isinstance(value, float) else value


def is_histogram(value):
    return isinstance(value, list) and len(value) > 40 and isinstance(value[0], float)


def parts_table(shapes):
    """Numbers of parts as Markdown, and the pictures of a few shapes at the middle level of noise."""
    lines = ["## Parts", "", "Numbers of parts without noise, with 0.3% and with 0.5% of the diagonal.", "",
             "| shape | paper's rules | morsel |", "| --- | ---: | ---: |"]
    for shape in shapes:
        counts = [", ".join(str(r["parts"]) if r["verdict"] == "solid" else "no solid"
                            for r in shape["runs"] if r["method"] == way) for way in WAYS]
        lines.append(f'| {shape["name"]} | {counts[0]} | {counts[1]} |')
    return lines + [""]


def kept_picture(page, folder, name, alt, width):
    shutil.copy(page.folder / name, folder)
    return f'<img src="{pathlib.PurePath(name).name}" width="{width}" alt="{html.escape(alt)}">'


def write_docs(page, folder):
    folder.mkdir(parents=True, exist_ok=True)
    f = page.figures
    (folder / "figures.json").write_text(json.dumps(small_form(f), indent=1) + "\n", encoding="utf-8")
    missing = [] if is_complete(f) else ["The run was ended before the claims were measured.", ""]
    rows = [f'| {r["points"]:,} | {r["paper_seconds"]:g} | {r["seconds"]:.2f} | {r["factor"]:.0f} |' for r in f["times"]["rows"]]
    lines = ["# The paper, reproduced", "",
             "The figures of the page that `make reproduce` builds in `out/reproduction/index.html`, in a small form: "
             "[figures.json](figures.json) has all of them.", "",
             f'morsel {f["version"]}, {f["date"][:10]}, {f["processor"]}, {f["cores"]} cores, possibly with other work.', "",
             *missing, "## Times", "", "| points | paper, s | morsel, s | factor |", "| ---: | ---: | ---: | ---: |", *rows, ""]
    for key, data in collections(page):
        lines += [f"## Retrieval, {NAMES[key]}", "", "| score | NN | first tier | second tier | DCG |", "| --- | ---: | ---: | ---: | ---: |"]
        lines += [f'| {r["name"]} | {r["nearest_neighbor"]:.3f} | {r["first_tier"]:.3f} | {r["second_tier"]:.3f} | {r["discounted_gain"]:.3f} |'
                  for r in data["matrix"]["scorings"]]
        lines += [""]
    for name, rows in f.get("claims", {}).get("curves", {}).items():
        lines += [f"## Rand error against {name}, generated figures", "", f"| {name} | morsel | paper's rules |", "| ---: | ---: | ---: |"]
        lines += [f'| {percent(r[name])} | {r["default"]:.3f} | {r["paper"]:.3f} |' for r in rows] + [""]
    lines += parts_table(f["parts"]["shapes"])
    lines += ["Left the paper's rules, right morsel, noise of 0.3%:", ""]
    for shape in f["parts"]["shapes"][1:7:2]:
        lines += [kept_picture(page, folder, r["picture"], f'{shape["name"]}, {WAYS[r["method"]]}', 300)
                  for r in shape["runs"] if r["noise"] == 0.003] + [""]
    lines += ["## The steps in the plane", ""]
    lines += [kept_picture(page, folder, name, "a step in the plane", 380)
              for name in [*f["plane"]["steps"][3:], f["plane"]["saddle"]["picture"]]]
    (folder / "README.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--docs", type=pathlib.Path)
    options = parser.parse_args()
    page = Page(options.folder)
    write_page(page)
    if options.docs:
        write_docs(page, options.docs)
    print(f"Look at {options.folder / 'index.html'}")


if __name__ == "__main__":
    main()
