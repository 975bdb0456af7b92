#pragma once

#include <bdpt/eval/bench.h>
#include <bdpt/eval/comparison.h>
#include <bdpt/eval/metric.h>
#include <bdpt/eval/verify.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "options/option_list.h"
#include "options/part_arguments.h"
#include "options/render_arguments.h"

namespace bdpt::app {

/// Arguments of `bdpt compare`.
struct CompareArguments {
    std::filesystem::path image{};  ///< an image, or a folder of images
    std::filesystem::path reference{};
    std::optional<std::string> layer{};
    eval::ComparisonOptions options{};
    std::vector<eval::Threshold> thresholds{};
    std::optional<std::filesystem::path> error_image{};
    double scale = 1.0;  ///< scale of the error image
    Printed printed{};
};

/// Options of `bdpt compare`, as given.
struct CompareRequest {
    CompareArguments arguments{};
    std::optional<std::vector<eval::Metric>> metrics{};  ///< none: all
};

extern const char* const compare_footer;

/// Adds the options of `bdpt compare`.
void add_compare_options(OptionList& options, CompareRequest& request);

/// Checks and converts the options; adds the metrics of thresholds to those that are measured.
[[nodiscard]] CompareArguments checked(const CompareRequest& request, const OptionList& options);

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

/// Arguments of `bdpt verify`.
struct VerifyArguments {
    RenderArguments stage{};  ///< scene and view
    eval::VerifyOptions options{};
};

/// Options of `bdpt verify`, as given.
struct VerifyRequest {
    RenderRequest render{};  ///< options shared with `bdpt render`; the rest is unused
    eval::VerifyOptions options{};
};

extern const char* const verify_footer;

/// Adds the options of `bdpt verify`.
void add_verify_options(OptionList& options, VerifyRequest& request);

/// Checks and converts the options. Throws `OptionError` for incompatible ones.
[[nodiscard]] VerifyArguments checked(const VerifyRequest& request, const OptionList& options);

}  // namespace bdpt::app
