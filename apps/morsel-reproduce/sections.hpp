// morsel-reproduce: the sections of the page; each adds its figures to the study.
#pragma once

#include "describe.hpp"
#include "study.hpp"

namespace morsel::reproduce {

/// Figures 1 and 2, in the plane.
void add_plane(Study& study);

/// Figures 3 and 4: parts in colours under noise, by both methods, and their representative points.
void add_parts(Study& study);

/// The table of times.
void add_times(Study& study);

/// The shapes of the matrix, out of our own generator.
[[nodiscard]] Collection make_generated(const Study& study);
/// Classes of the Princeton Shape Benchmark, as many and as large; its folder holds a .cla file.
[[nodiscard]] Collection make_psb(const Study& study);

/// Figures 5, 6 and 7 of a collection, under its name.
void add_retrieval(Study& study, const std::string& name, const Collection& collection);

/// What the paper claims, measured.
void add_claims(Study& study, const Collection& generated);
/// Rand error on people's segmentations of meshes.
void add_annotated(Study& study);

}  // namespace morsel::reproduce
