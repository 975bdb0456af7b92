#pragma once

/// @file
/// Writes a benchmark as JSON, as CSV and as a page of HTML.
///
/// @code{.cpp}
/// void write_bench(const bdpt::eval::BenchRecord& record)
/// {
///     std::ofstream("out/bench/results.json") << bdpt::eval::bench_json(record);
///     std::ofstream("out/bench/report.html") << bdpt::eval::bench_page(record, "out/bench");
/// }
/// @endcode

#include <bdpt/eval/bench/bench.h>
#include <bdpt/eval/bench/machine.h>
#include <bdpt/export.h>

#include <filesystem>
#include <string>
#include <vector>

namespace bdpt::eval {

/// A benchmark with all data needed to repeat it.
struct BenchRecord {
    BenchOptions options;
    MachineFacts machine;
    std::string started;  ///< UTC, ISO 8601
    std::string command;  ///< command line as typed
    std::vector<SceneResult> scenes;
};

/// Returns the record as a JSON object, as described in docs/bench.md.
[[nodiscard]] BDPT_EXPORT std::string bench_json(const BenchRecord& record);

/// Returns the record as CSV: a line for each checkpoint of each run.
[[nodiscard]] BDPT_EXPORT std::string bench_csv(const BenchRecord& record);

/// Returns a self-contained HTML page of the record and the images in `folder`. Throws `Error` like
/// `io::read_image`, or out_of_memory.
[[nodiscard]] BDPT_EXPORT std::string bench_page(const BenchRecord& record,
                                                 const std::filesystem::path& folder);

}  // namespace bdpt::eval
