// The paper's score of two sets of weighted points, with what it leaves open solved.
//
// Source: T. K. Dey, J. Giesen, S. Goswami, "Shape Segmentation and Matching from Noisy Point
// Clouds", SPBG 2004, section 4.
// Differs: docs/signature.md.
#pragma once

#include <morsel/signature.hpp>

#include "match/align.hpp"

namespace morsel {

struct PaperMatch {
  double score = 0.0;  ///< 0 … 1
  Alignment alignment;
};

/// Symmetric: exchanging the two gives the same score and the inverse alignment.
[[nodiscard]] PaperMatch paper_score(const Signature& target, const Signature& source, bool mirror);

/// The published rules to the letter, to compare with: `unit_…` scale each shape by its
/// axis-aligned bounding box (RMS radii per diagonal), points are matched greedily, and the roll
/// about the aligned line is left as it is. Not invariant to rotation.
[[nodiscard]] double literal_paper_score(const Signature& target, const Signature& source,
                                         double unit_target, double unit_source);

}  // namespace morsel
