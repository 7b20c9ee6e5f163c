// SPDX-License-Identifier: Apache-2.0
// Kosanam's chapter VI: a gain found by search, on a vehicle.

#include "tuner_design/kosanam/gain_search.h"
#include "tuner_design/report/page/bar_chart.h"
#include "tuner_design/report/page/text.h"
#include "tuner_design/report/study_sections/study_sections.h"

namespace ehm::tuner_design::report {
namespace {

/// Share of the Kalman filter's error that gain `i` saved in the thesis; not a number where it has none.
double published(const GainSearchRow& row, std::size_t i) {
  const double share = i == 0 ? 0.0 : i == 1 ? row.published_robust : row.published_searched;
  return share > 0.0 ? 100.0 * share : no_number;
}

DataTable table_of(const GainSearch& search) {
  DataTable table{{"uncertain", "gain", "K1", "K2 [1/s]", "error of position [ft]", "saved [%]", "published [%]"}, {}};
  for (const GainSearchRow& row : search.rows)
    for (std::size_t i = 0; i < row.gains.size(); ++i)
      table.rows.push_back({row.uncertainty, row.gains[i].name, row.gains[i].K(0), row.gains[i].K(1),
                            row.gains[i].error_ft, 100.0 * row.saved(i), published(row, i)});
  return table;
}

BarChart bars_of(const GainSearch& search) {
  BarChart chart{.id = "kosanam-ga-bars",
                 .title = "Error of position by gain",
                 .description =
                     "Root mean square error of position of the Kalman, the robust and the searched gain, with "
                     "what the thesis' savings would leave.",
                 .categories = {},
                 .series = {{"ours", {}}},
                 .marks = {{"what the published saving would leave", {}, Mark::diamond, 2}},
                 .axis_title = "RMS error of position, ft"};
  for (const GainSearchRow& row : search.rows) {
    for (std::size_t i = 0; i < row.gains.size(); ++i) {
      chart.categories.push_back(row.gains[i].name + ", " + row.uncertainty + " uncertain");
      chart.series[0].values.push_back(row.gains[i].error_ft);
      chart.marks[0].values.push_back(row.gains[0].error_ft * (1.0 - 0.01 * published(row, i)));
    }
  }
  return chart;
}

}  // namespace

Section gain_search_section(const GainSearch& search) {
  const GainSearchOptions& o = search.options;
  Section section{"kosanam-ga", "Kosanam, chapter VI: a searched gain"};
  section.add_text("A vehicle on a straight line, its position measured; errors on " + std::to_string(o.test_runs) +
                   " runs that the search has not seen. The search is NLopt's GN_ESCH with " +
                   std::to_string(o.evaluations) + " evaluations of " + std::to_string(o.training_runs) +
                   " runs; the thesis has a genetic algorithm of its own, and gives no numbers of its vehicle.");
  const BarChart bars = bars_of(search);
  section.add_figure("kosanam-ga-figure", "Error of position by gain.",
                     "Where a bar ends at its diamond, our saving is the published one.", responsive(bars),
                     table_of(search));
  section.add_table("kosanam-ga-table", "Gains and errors; saved: of the Kalman filter's error", table_of(search));
  return section;
}

}  // namespace ehm::tuner_design::report
