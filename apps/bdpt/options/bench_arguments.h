#pragma once

#include <bdpt/eval/bench/bench_options.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "options/render_arguments.h"

namespace CLI {
class App;
}

namespace bdpt::app {

/// The words of `bdpt bench` as they were given.
struct BenchWords {
    std::vector<std::string> files;
    std::string output;
    std::optional<std::string> integrators;
    std::optional<std::string> time;
    std::optional<std::int64_t> samples;
    std::optional<int> seeds;
    std::optional<std::string> reference;
    std::optional<std::string> reference_time;
    std::optional<int> strategy_depth;
    RenderWords render;  ///< what scenes, views and renders have in common with `bdpt render`
    bool quick = false;
    bool json = false;
    bool quiet = false;
};

/// A scene of a benchmark.
struct BenchSubject {
    std::string name;        ///< of files; no other scene has it
    RenderArguments render;  ///< how it is loaded and seen
};

/// What `bdpt bench` is to do.
struct BenchArguments {
    std::vector<BenchSubject> subjects;
    std::filesystem::path folder;
    eval::BenchOptions options;
    std::optional<Size> size;
    int pixels = 0;  ///< of each image without `size`, at about
    Format format = Format::text;
    Verbosity verbosity = Verbosity::normal;
};

/// Describes the options of `bdpt bench` to the parser, which will store into `words`.
void add_bench_options(CLI::App& command, BenchWords& words);

/// Throws `Error` (usage) for words that make no sense.
[[nodiscard]] BenchArguments understand(const BenchWords& words);

/// The image of about `pixels` pixels with the proportions of `whole`.
[[nodiscard]] Size bench_size(const Size& whole, int pixels);

}  // namespace bdpt::app
