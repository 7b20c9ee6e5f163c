// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/page/svg.h"

#include <fmt/format.h>

#include "tuner_design/report/page/text.h"

namespace ehm::tuner_design::report {
namespace {

/// A tenth of a pixel is enough, and the same on every machine.
std::string px(double value) {
  std::string text = fmt::format("{:.1f}", value);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

std::string joined(const Points& points) {
  std::string text;
  for (const auto& [x, y] : points) text += (text.empty() ? "" : " ") + px(x) + ',' + px(y);
  return text;
}

constexpr const char* anchor_names[] = {"start", "middle", "end"};

}  // namespace

Svg::Svg(std::string_view id, double width, double height, std::string_view title, std::string_view description) {
  const std::string name = escaped(id);
  body_ = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}" role="img" )"
      R"(aria-labelledby="{2}-title {2}-desc"><title id="{2}-title">{3}</title><desc id="{2}-desc">{4}</desc>)",
      px(width), px(height), name, escaped(title), escaped(description));
}

void Svg::rect(double x, double y, double width, double height, std::string_view style, std::string_view attributes) {
  body_ += fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}" class="{}"{}{}/>)", px(x), px(y), px(width),
                       px(height), style, attributes.empty() ? "" : " ", attributes);
}

void Svg::line(double x1, double y1, double x2, double y2, std::string_view style) {
  body_ += fmt::format(R"(<line x1="{}" y1="{}" x2="{}" y2="{}" class="{}"/>)", px(x1), px(y1), px(x2), px(y2), style);
}

void Svg::polyline(const Points& points, std::string_view style) {
  body_ += fmt::format(R"(<polyline points="{}" class="{}"/>)", joined(points), style);
}

void Svg::polygon(const Points& points, std::string_view style) {
  body_ += fmt::format(R"(<polygon points="{}" class="{}"/>)", joined(points), style);
}

void Svg::circle(double x, double y, double radius, std::string_view style) {
  body_ += fmt::format(R"(<circle cx="{}" cy="{}" r="{}" class="{}"/>)", px(x), px(y), px(radius), style);
}

void Svg::text(double x, double y, std::string_view text, std::string_view style, Anchor anchor) {
  body_ += fmt::format(R"(<text x="{}" y="{}" class="{}" text-anchor="{}">{}</text>)", px(x), px(y), style,
                       anchor_names[static_cast<int>(anchor)], escaped(text));
}

void Svg::turned_text(double x, double y, double degrees, std::string_view text, std::string_view style,
                      Anchor anchor) {
  body_ += fmt::format(R"svg(<text transform="translate({},{}) rotate({})" class="{}" text-anchor="{}">{}</text>)svg",
                       px(x), px(y), px(degrees), style, anchor_names[static_cast<int>(anchor)], escaped(text));
}

void Svg::open(std::string_view tip) {
  body_ += "<g><title>" + escaped(tip) + "</title>";
}

void Svg::close() {
  body_ += "</g>";
}

}  // namespace ehm::tuner_design::report
