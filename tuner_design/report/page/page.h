// SPDX-License-Identifier: Apache-2.0
#pragma once
// The report as one self-contained page: XHTML-compatible HTML, no script, nothing fetched. A section is text, figures
// and tables; each figure and table carries its numbers as a CSV link. Texts are escaped here, `body` is markup.
// Errors: none.

#include <string>
#include <utility>
#include <vector>

#include "tuner_design/report/page/data_table.h"

namespace ehm::tuner_design::report {

/// A number that one remembers, with what it is.
struct KeyFigure {
  std::string value, unit, meaning;
};

struct Section {
  std::string id, title;
  std::string html{};
  std::vector<std::pair<std::string, DataTable>> data{};  ///< by the id of its figure or table

  void add_text(const std::string& text);
  void add_key_figures(const std::vector<KeyFigure>& figures);
  /// `reading` is one sentence: how to read it.
  void add_figure(const std::string& figure_id, const std::string& figure_title, const std::string& reading,
                  const std::string& body, DataTable table);
  /// The last `totals` rows are sums.
  void add_table(const std::string& table_id, const std::string& caption, DataTable table, std::size_t totals = 0);
};

struct Page {
  std::string title, subtitle, footer;
  std::vector<Section> sections;
  std::string kind = "Tuner design report";  ///< above the title, and in the browser's
};

std::string to_html(const Page& page);

}  // namespace ehm::tuner_design::report
