"""Runs the whole reproduction quickly, without any data, and looks at what comes out.

Usage: page_test.py PROGRAM
"""

import html.parser
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import charts  # noqa: E402
import page  # noqa: E402

PROGRAM = None


class References(html.parser.HTMLParser):
    """What a page refers to, and the ids that it has."""

    def __init__(self):
        super().__init__()
        self.found, self.ids, self.tags = [], set(), set()

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        for name, value in attrs:
            if name in ("src", "href", "srcset", "data", "action", "poster"):
                self.found.append(value)
            if name == "id":
                self.ids.add(value)


class Charts(unittest.TestCase):
    def test_ticks_are_round_and_within(self):
        self.assertEqual(charts.ticks(0, 1), [0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0])
        self.assertEqual(charts.ticks(1, 8, 6), [2, 4, 6, 8])

    def test_runs(self):
        self.assertEqual(charts.runs_of(["a", "a", "b", "a"]), [["a", 0, 2], ["b", 2, 1], ["a", 3, 1]])

    def test_matrix_shades_own_class_and_others(self):
        svg = charts.matrix(["a", "a", "b"], [[1], [2], [0]])
        own, other = (svg.split(f"fill=\"var(--s{i})\"")[0].rsplit('d="', 1)[1] for i in (1, 2))
        self.assertEqual((own.count("M"), other.count("M")), (1, 2))


class Growth(unittest.TestCase):
    def test_is_the_exponent(self):
        rows = [{"points": n, "seconds": 3e-9 * n**1.8} for n in (10, 100, 1000)]
        self.assertAlmostEqual(page.growth(rows, "seconds"), 1.8)


class Reproduction(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        subprocess.run([PROGRAM, "--quick", "--out", cls.folder], check=True, stdout=subprocess.DEVNULL)
        subprocess.run([sys.executable, "-B", HERE / "page.py", cls.folder, "--docs", cls.folder / "docs"],
                       check=True, stdout=subprocess.DEVNULL)
        cls.figures = json.loads((cls.folder / "figures.json").read_text())
        cls.text = (cls.folder / "index.html").read_text()

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def numbers(self, value, path=""):
        if isinstance(value, dict):
            for key, inner in value.items():
                yield from self.numbers(inner, f"{path}/{key}")
        elif isinstance(value, list):
            for i, inner in enumerate(value):
                yield from self.numbers(inner, f"{path}/{i}")
        elif value is None or isinstance(value, float):
            yield path, value

    def test_all_figures_are_numbers(self):
        for path, value in self.numbers(self.figures):
            self.assertTrue(value is not None and math.isfinite(value), path)

    def test_rates_are_between_0_and_1(self):
        names = ("nearest_neighbor", "first_tier", "second_tier", "discounted_gain", "error", "default", "paper")
        checked = 0
        for path, value in self.numbers(self.figures):
            if path.rsplit("/", 1)[1] in names:
                self.assertTrue(0 <= value <= 1 + 1e-12, path)
                checked += 1
        self.assertGreater(checked, 50)

    def test_steps_in_the_plane(self):
        plane = self.figures["plane"]
        self.assertEqual(len(plane["steps"]), 6)
        self.assertTrue(0 < plane["small_balls"] < plane["triangles"])
        self.assertTrue(1 < plane["parts"] < plane["maxima"] < plane["inner"])
        self.assertGreater(min(plane["saddle"]["maxima"]), plane["saddle"]["radius"])

    def test_both_methods_at_three_levels_of_noise(self):
        for shape in self.figures["parts"]["shapes"]:
            self.assertEqual(sorted((r["method"], r["noise"]) for r in shape["runs"]),
                             [(m, n) for m in ("default", "paper") for n in (0.0, 0.003, 0.005)])

    def test_six_times(self):
        rows = self.figures["times"]["rows"]
        self.assertEqual([r["paper_seconds"] for r in rows], [19.8, 232, 399, 475, 1049, 1455])
        for row in rows:
            self.assertAlmostEqual(row["factor"], row["paper_seconds"] / row["seconds"])

    def test_seventeen_classes_five_best_of_each(self):
        matrix = self.figures["retrieval"]["generated"]["matrix"]
        self.assertEqual(len(set(matrix["categories"])), 17)
        self.assertEqual(len(matrix["scorings"]), 5)
        for scoring in matrix["scorings"]:
            for query, best in enumerate(scoring["best"]):
                self.assertEqual(len(set(best)), 5)
                self.assertNotIn(query, best)

    def test_counts_of_triples_add_up(self):
        data = self.figures["retrieval"]["generated"]
        categories = data["matrix"]["categories"]
        triples = sum(sum(c == q for c in categories) - 1 for q in categories for o in categories if o != q)
        for row in data["d2"]["counts"]:
            self.assertEqual(sum(v for k, v in row.items() if k != "name"), triples)
        case = data["d2"]["case"]
        self.assertLess(case["other"]["d2_distance"], case["same"]["d2_distance"])
        self.assertGreater(case["same"]["score"], case["other"]["score"])
        self.assertEqual(case["same"]["category"], case["query"]["category"])
        self.assertNotEqual(case["other"]["category"], case["query"]["category"])

    def test_claims(self):
        claims = self.figures["claims"]
        self.assertEqual(claims["repeatability"]["same"], claims["repeatability"]["shapes"])
        self.assertLess(claims["invariance"]["score"], 0.2)
        for curve in ("noise", "outliers"):
            self.assertGreaterEqual(len(claims["curves"][curve]), 2)

    def test_page_is_self_contained(self):
        references = References()
        references.feed(self.text)
        for reference in references.found:
            inside = reference.startswith("data:image/") or reference[1:] in references.ids
            self.assertTrue(inside, reference[:80])
        self.assertFalse({"script", "link", "iframe", "object"} & references.tags)
        self.assertNotIn("@import", self.text)
        self.assertNotIn("://", self.text)

    def test_page_shows_every_section(self):
        for anchor in ("plane", "parts", "balls", "queries", "times", "matrix", "d2", "claims"):
            self.assertIn(f'id="{anchor}"', self.text)
        self.assertNotIn("nan", self.text.replace("nanoflann", "").split("<main>")[1].split("data:image")[0])

    def test_small_form(self):
        docs = self.folder / "docs"
        kept = json.loads((docs / "figures.json").read_text())
        self.assertEqual(len(kept["times"]["rows"]), 6)
        text = (docs / "README.md").read_text()
        for line in text.splitlines():
            if line.startswith("<img"):
                self.assertTrue((docs / line.split('"')[1]).is_file())


if __name__ == "__main__":
    PROGRAM = sys.argv.pop()
    unittest.main()
