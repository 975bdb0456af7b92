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
    std::string name;        ///< in file names; unique
    RenderArguments render;  ///< arguments for loading and rendering
};

/// Arguments of `bdpt bench`.
struct BenchArguments {
    std::vector<BenchSubject> subjects{};
    std::filesystem::path folder{};
    eval::BenchOptions options{};
    std::optional<Size> size{};
    int pixels = 0;  ///< approximate number per image, if there is no `size`
    Printed printed{};
};

/// Options of `bdpt bench`, as given.
struct BenchRequest {
    std::vector<std::string> files{};
    BenchArguments arguments{};
    std::optional<double> reference_seconds{};
    RenderRequest render{};  ///< options of scenes, views and renders shared with `bdpt render`
    bool quick = false;
};

extern const char* const bench_footer;

/// Adds the options of `bdpt bench`.
void add_bench_options(OptionList& options, BenchRequest& request);

/// Checks and converts the options. Throws `OptionError` for incompatible ones.
[[nodiscard]] BenchArguments checked(const BenchRequest& request, const OptionList& options);

/// Returns the size of an image of about `pixels` pixels with the proportions of `whole`.
[[nodiscard]] Size bench_size(const Size& whole, int pixels);

}  // namespace bdpt::app
