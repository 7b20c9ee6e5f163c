// SPDX-License-Identifier: Apache-2.0
#include "monitor/export/process_metrics.h"

#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "deploy/runtime/service/log.h"

namespace ehm::monitor {

namespace {

using prometheus::MetricFamily;
using prometheus::MetricType;

MetricFamily single(const char* name, const char* help, MetricType type, double value) {
  prometheus::ClientMetric metric;
  metric.gauge.value = metric.counter.value = value;
  return {name, help, type, {metric}};
}

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

}  // namespace

std::vector<MetricFamily> process_metrics() {
  std::vector<MetricFamily> families;
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) == 0)
    families.push_back(single("process_cpu_seconds_total", "User and system processor time of the monitor.",
                              MetricType::Counter, seconds(usage.ru_utime) + seconds(usage.ru_stime)));
  // Pages: total size, then what is resident.
  double total_pages = 0, resident_pages = 0;
  if (std::ifstream("/proc/self/statm") >> total_pages >> resident_pages) {
    const auto page_bytes = static_cast<double>(sysconf(_SC_PAGESIZE));
    families.push_back(single("process_resident_memory_bytes", "Memory of the monitor that is in RAM.",
                              MetricType::Gauge, page_bytes * resident_pages));
    families.push_back(single("process_virtual_memory_bytes", "Address space of the monitor.", MetricType::Gauge,
                              page_bytes * total_pages));
  }
  std::error_code error;
  std::size_t open = 0;
  for (std::filesystem::directory_iterator it("/proc/self/fd", error), end; !error && it != end; it.increment(error))
    ++open;
  if (!error)  // less the one that counts them
    families.push_back(single("process_open_fds", "Open file descriptors of the monitor.", MetricType::Gauge,
                              static_cast<double>(open) - 1));
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) == 0)
    families.push_back(single("process_max_fds", "File descriptors that the monitor may open.", MetricType::Gauge,
                              static_cast<double>(limit.rlim_cur)));
  families.push_back(single("ehm_log_lines_lost_total", "Lines of the log that its reader was too slow for.",
                            MetricType::Counter, static_cast<double>(service::lost_log_lines())));
  return families;
}

}  // namespace ehm::monitor
