#pragma once

#include <bdpt/eval/compare/comparison.h>
#include <bdpt/eval/compare/threshold.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "terminal/console.h"

namespace CLI {
class App;
}

namespace bdpt::app {

/// The words of `bdpt compare` as they were given.
struct CompareWords {
    std::string image;
    std::string reference;
    std::optional<std::string> layer;
    std::optional<std::string> metrics;
    std::vector<std::string> thresholds;
    double epsilon = 0.01;
    bool relative = false;
    std::optional<double> peak;
    std::optional<double> pixels_per_degree;
    std::optional<std::string> exposures;
    std::optional<double> exposure;
    int tile_size = 32;
    int worst_tiles = 5;
    std::optional<std::string> error_image;
    std::string error_metric = "relmse";
    double scale = 1.0;
    bool json = false;
    bool quiet = false;
};

/// What `bdpt compare` is to do.
struct CompareArguments {
    std::filesystem::path image;  ///< an image, or a folder of them
    std::filesystem::path reference;
    std::optional<std::string> layer;
    eval::ComparisonOptions options;
    std::vector<eval::Threshold> thresholds;
    std::optional<std::filesystem::path> error_image;
    double scale = 1.0;  ///< of the error image
    Format format = Format::text;
    Verbosity verbosity = Verbosity::normal;
};

/// Describes the options of `bdpt compare` to the parser, which will store into `words`.
void add_compare_options(CLI::App& command, CompareWords& words);

/// Throws `Error` (usage) for words that make no sense.
[[nodiscard]] CompareArguments understand(const CompareWords& words);

}  // namespace bdpt::app
