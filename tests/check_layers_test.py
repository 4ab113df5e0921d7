#!/usr/bin/env python3
"""Each rule of check_layers.py finds its own breach in a small project, and nothing else."""

import pathlib
import tempfile
import unittest

import check_layers


class CheckLayers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.write("CMakeLists.txt", "set(MORSEL_MODULES base delaunay)\n")
        self.write("include/morsel/a.hpp", "#pragma once\n#include <vector>\n#include <morsel/b.hpp>\n")
        self.write("src/base/x.cpp", '#include "base/x.hpp"\n')
        self.write("src/base/x_test.cpp", "#include <gtest/gtest.h>\n")
        self.write("src/delaunay/triangulate.cpp",
                   '#include <CGAL/Delaunay_triangulation_3.h>\n#include "base/x.hpp"\n')
        self.write("src/delaunay/delaunay_test.cpp", "")

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def assert_one(self, expected):
        self.assertEqual(check_layers.check(self.root), [expected])

    def test_a_good_project_passes(self):
        self.assertEqual(check_layers.check(self.root), [])

    def test_forward_use(self):
        self.write("src/base/y.cpp", '\n#include "delaunay/d.hpp"\n')
        self.assert_one("src/base/y.cpp:2: base must not use delaunay")

    def test_unknown_module(self):
        self.write("src/base/y.cpp", '#include "other/d.hpp"\n')
        self.assert_one('src/base/y.cpp:1: "other/d.hpp" is of no module of src/')

    def test_unlisted_folder(self):
        self.write("src/extra/y.cpp", "")
        self.assert_one("src/extra: not in MORSEL_MODULES")

    def test_second_triangulation(self):
        self.write("src/delaunay/y.cpp", "#include <CGAL/Delaunay_triangulation_3.h>\n")
        self.assert_one("src/delaunay/y.cpp:1: only src/delaunay/triangulate.cpp includes CGAL's "
                        "triangulation")

    def test_third_party_in_a_public_header(self):
        self.write("include/morsel/c.hpp", "#pragma once\n#include <Eigen/Core>\n")
        self.assert_one("include/morsel/c.hpp:2: a public header must not include Eigen/Core")

    def test_bindings_reach_inside(self):
        self.write("python/src/a.hpp", "")
        self.write("python/src/a.cpp", '#include <morsel/a.hpp>\n#include <pybind11/stl.h>\n'
                                       '#include <memory>\n#include "a.hpp"\n#include "base/x.hpp"\n')
        self.assert_one("python/src/a.cpp:5: python/src must not include base/x.hpp")

    def test_no_pragma_once(self):
        self.write("include/morsel/c.hpp", "")
        self.assert_one("include/morsel/c.hpp: lacks #pragma once")

    def test_module_without_test(self):
        (self.root / "src/base/x_test.cpp").unlink()
        self.assert_one("src/base: has no *_test.cpp")


if __name__ == "__main__":
    unittest.main()
