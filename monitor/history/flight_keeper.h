// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sums up flights on a thread of its own: margins by the engine model, the engine's baseline and history in their
// folder, and the summary for whoever publishes it. The cycle thread hands over a plain copy at landing through a
// bounded queue; what finds no room is handed over at a later turn.
//
// Before an engine's first sample its filter is started from what its last flight has taught. A disk that refuses costs
// the files only: an event tells when that begins and ends, and what a later flight adds does not hold what was missed.
//
// Not taken: a baseline of another engine type or estimator, or a damaged one; an event says which file and why, and it
// is kept beside the next one as NAME.refused. After
// a washing the health is less certain by `wash_percent`; after a replacement of parts the engine is as unknown as any.

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "monitor/data/options.h"
#include "monitor/history/baseline.h"
#include "monitor/history/flight_entry.h"
#include "monitor/history/history_folder.h"
#include "monitor/onboard/on_board_model.h"
#include "monitor/realtime/spsc_queue.h"
#include "monitor/shared/engine_table.h"
#include "monitor/shared/mailbox.h"
#include "monitor/shared/notice_board.h"

namespace ehm::monitor {

/// Washing gives back a percent or so of what fouling took.
inline constexpr double wash_percent = 1.0;

struct SummedFlight {
  std::uint32_t engine_id = 0;
  Flight flight;
};
using FlightBoard = Mailbox<SummedFlight>;

class FlightKeeper {
 public:
  /// All must outlive this. Reads what the folder holds; nothing is read or written where `history.directory` is empty.
  FlightKeeper(const MonitorConfig& config, const EngineTable& engines, NoticeBoard& notices, FlightBoard& summaries);
  /// Sums up what is queued, then ends the thread.
  ~FlightKeeper();

  /// Before an engine's first sample. Whether it starts from a baseline: not one that goes on from a checkpoint of this
  /// flight, which knows more. Real-time safe: yes.
  bool begin(EngineSlot& slot, bool goes_on) noexcept;
  /// After each sample in order, before its events are cleared: at a landing the engine's next flight begins, and this
  /// one is handed over. Real-time safe: yes.
  void follow(EngineSlot& slot) noexcept;
  /// Hands over what found no room before. Real-time safe: yes.
  void hand_over(EngineSlot& slot) noexcept;
  /// Before a table flies: makes its designs known. From any thread but the cycle's.
  void add_designs(const EngineTable& engines);

 private:
  struct Landing {
    std::uint32_t engine_id = 0;
    std::array<char, 64> design_hash{};
    FlightTotals totals;
    estimation::Learned learned;
  };
  /// What the cycle thread knows of an engine; in a table that does not grow while it flies.
  struct Known {
    std::uint32_t engine_id = 0, flights = 0;
    estimation::Learned learned;  ///< empty: nothing
  };
  /// A design's engine, for the margins; made at its first landing.
  struct Prepared {
    design::Design design;
    std::shared_ptr<const onboard::OnBoardModel> model;  ///< null: the published estimator has none
  };
  Known* find(std::uint32_t engine_id) noexcept;
  void remember(const EngineSlot& slot) noexcept;
  void load(const EngineTable& engines);
  FlightHistory readable_history(std::uint32_t engine_id);
  void load_baseline(const EngineTable& engines, const FlightHistory& history, Known& known);
  void say(std::uint32_t engine_id, bool raised, std::string text);
  const Prepared* prepared(const std::string& design_hash);
  void run();
  void sum_up(const Landing& landing);
  void store(const Prepared& prepared, const Landing& landing, Flight& flight);
  void tell(bool failing, const std::string& why);

  HistoryOptions options_;
  EstimatorOptions estimator_;
  NoticeBoard& notices_;
  FlightBoard& summaries_;
  std::vector<Known> known_;
  std::map<std::uint32_t, Baseline> baselines_;  ///< of this thread, after construction
  std::set<std::uint32_t> refused_;  ///< engines whose file was not taken: it is put aside before another is written
  std::mutex prepared_mutex_;
  std::map<std::string, Prepared> prepared_;  ///< by design hash
  bool failing_ = false;
  Landing landing_;  ///< being handed over
  std::unique_ptr<SpscQueue<Landing, 16>> queue_ = std::make_unique<SpscQueue<Landing, 16>>();
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace ehm::monitor
