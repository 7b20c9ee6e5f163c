// SPDX-License-Identifier: Apache-2.0
#pragma once
// One drawing as inline SVG. Coordinates in px, x to the right, y downwards. Colours and fonts are classes of the page
// (page_style.h), so that light, dark and print are the page's affair. Every text is escaped here. Errors: none.
// Source: SVG 1.1 (W3C); title and desc with role="img" are what screen readers announce.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ehm::tuner_design::report {

using Points = std::vector<std::pair<double, double>>;

enum class Anchor { start, middle, end };

class Svg {
 public:
  /// `id` is unique on the page.
  Svg(std::string_view id, double width, double height, std::string_view title, std::string_view description);

  /// `attributes` is markup, as in fill-opacity="0.3".
  void rect(double x, double y, double width, double height, std::string_view style, std::string_view attributes = "");
  void line(double x1, double y1, double x2, double y2, std::string_view style);
  void polyline(const Points& points, std::string_view style);
  void polygon(const Points& points, std::string_view style);
  void circle(double x, double y, double radius, std::string_view style);
  void text(double x, double y, std::string_view text, std::string_view style, Anchor anchor = Anchor::start);
  /// Turned by `degrees` clockwise about its anchor.
  void turned_text(double x, double y, double degrees, std::string_view text, std::string_view style, Anchor anchor);
  /// What follows until close() shows `tip` under the mouse.
  void open(std::string_view tip);
  void close();

  std::string markup() const { return body_ + "</svg>"; }

 private:
  std::string body_;
};

}  // namespace ehm::tuner_design::report
