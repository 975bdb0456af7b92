#pragma once

#include <bdpt/eval/bench/bench_options.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "options/render_arguments.h"

namespace bdpt::app {

/// A scene of a benchmark.
struct BenchSubject {
    std::string name;        ///< of files; no other scene has it
    RenderArguments render;  ///< how it is loaded and seen
};

/// What `bdpt bench` is to do.
struct BenchArguments {
    std::vector<BenchSubject> subjects{};
    std::filesystem::path folder{};
    eval::BenchOptions options{};
    std::optional<Size> size{};
    int pixels = 0;  ///< of each image without `size`, at about
    Printed printed{};
};

/// The options of `bdpt bench`, as they are given.
struct BenchRequest {
    std::vector<std::string> files{};
    BenchArguments arguments{};
    std::optional<double> reference_seconds{};
    RenderRequest render{};  ///< what scenes, views and renders have in common with `bdpt render`
    bool quick = false;
};

extern const char* const bench_footer;

/// Adds the options of `bdpt bench`.
void add_bench_options(OptionList& options, BenchRequest& request);

/// Throws `OptionError` for options that do not go together.
[[nodiscard]] BenchArguments checked(const BenchRequest& request, const OptionList& options);

/// The image of about `pixels` pixels with the proportions of `whole`.
[[nodiscard]] Size bench_size(const Size& whole, int pixels);

}  // namespace bdpt::app
