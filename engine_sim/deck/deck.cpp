// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/deck/deck.h"

#include <algorithm>
#include <span>
#include <stdexcept>

#include "deploy/runtime/long_work/parallel_for.h"
#include "engine_sim/deck/deck_columns.h"
#include "engine_sim/model/ratings.h"

namespace ehm::engine_sim {
namespace {

/// Rows that are solved before they are written: bounds the memory, and long against the start of a thread.
constexpr std::size_t block_size = 1024;

struct DeckRow {
  std::string text;
  std::string reason;  ///< empty if it converged
  int iterations = 0;
  bool beyond_surge = false, beyond_ratings = false;
};

/// Outputs that are no inputs of these cases.
std::vector<const OutputChannel*> columns_of(const DeckCases& cases) {
  std::vector<const OutputChannel*> columns;
  for (const OutputChannel* output : deck_outputs()) {
    const auto& inputs = cases.columns;
    if (std::find(inputs.begin(), inputs.end(), output->column) == inputs.end()) columns.push_back(output);
  }
  return columns;
}

DeckRow solve_row(const Turbofan& engine, const DeckCase& one, const std::vector<const OutputChannel*>& columns) {
  DeckRow row{one.inputs, {}};
  try {
    const SteadyPoint point = solve_steady(engine, one.operation, one.demand);
    const GasPath& g = point.gas;
    row.iterations = point.iterations;
    row.beyond_surge =
        std::min({g.stall_margin_fan_percent, g.stall_margin_lpc_percent, g.stall_margin_hpc_percent}) < 0.0;
    row.beyond_ratings = limit_ratio(engine.data().ratings, g) > 1.0 + 1e-9;
    row.text += ",1";
    for (const OutputChannel* column : columns)
      row.text += ',' + files::shortest(column->read(g, engine.data().ratings));
  } catch (const std::exception& error) {  // whatever ends the solution, this row has none and the others go on
    row.text = one.inputs + ",0" + std::string(columns.size(), ',');
    row.reason = error.what();
  }
  row.text += '\n';
  return row;
}

/// Every row of the block; rows stay empty once it is stopped.
std::vector<DeckRow> solve_block(const Turbofan& engine, std::span<const DeckCase> block,
                                 const std::vector<const OutputChannel*>& columns, unsigned threads,
                                 const DeckSink& sink, std::size_t done_before) {
  std::vector<DeckRow> rows(block.size());
  long_work::parallel_for(
      block.size(), threads,
      [&](std::size_t i) {
        if (!sink.stopped()) rows[i] = solve_row(engine, block[i], columns);
      },
      [&](std::size_t done) { sink.progress(done_before + done); });
  return rows;
}

}  // namespace

std::string deck_header(const DeckCases& cases) {
  std::string header;
  for (const std::string& input : cases.columns) header += input + ',';
  header += "converged";
  for (const OutputChannel* column : columns_of(cases)) header += ',' + std::string(column->column);
  return header + '\n';
}

DeckSummary write_deck(const Turbofan& engine, const DeckCases& cases, unsigned threads, const DeckSink& sink) {
  const std::vector<const OutputChannel*> columns = columns_of(cases);
  DeckSummary summary;
  sink.write(deck_header(cases));
  while (summary.cases < cases.cases.size()) {
    const std::size_t size = std::min(block_size, cases.cases.size() - summary.cases);
    const std::span block = std::span(cases.cases).subspan(summary.cases, size);
    const std::vector<DeckRow> rows = solve_block(engine, block, columns, threads, sink, summary.cases);
    if (sink.stopped()) throw std::runtime_error("stopped by a signal");

    std::string text;
    for (std::size_t i = 0; i < size; ++i) {
      text += rows[i].text;
      summary.newton_iterations += rows[i].iterations;
      summary.beyond_surge += rows[i].beyond_surge ? 1 : 0;
      summary.beyond_ratings += rows[i].beyond_ratings ? 1 : 0;
      if (rows[i].reason.empty()) continue;
      ++summary.not_converged;
      sink.failed(block[i], rows[i].reason);
    }
    sink.write(text);
    summary.cases += size;
  }
  return summary;
}

}  // namespace ehm::engine_sim
