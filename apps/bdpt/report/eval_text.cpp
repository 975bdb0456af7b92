#include "report/reports.h"

#include <bdpt/eval/bench_report.h>
#include <bdpt/eval/verify.h>
#include <bdpt/options/option_fields.h>
#include <bdpt/options/option_text.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

namespace bdpt::app {

std::string bench_text(const eval::SceneResult& scene, double seconds)
{
    std::string result = fmt::format("{}: {} x {} pixels, reference with relMSE {:.2g}\n",
                                     scene.name, scene.width, scene.height, scene.reference_noise);
    result +=
        fmt::format("  {:<6}{:>8}{:>11}{:>24}{:>12}{:>12}{:>9}{:>10}\n", "", "samples", "relMSE",
                    "(least .. greatest)", "efficiency", "speed-up", "FLIP", "denoised");
    const auto flip_text = [](const std::optional<eval::Spread>& flip) {
        return flip ? fmt::format("{:.4f}", flip->median) : "-";
    };
    for (const eval::IntegratorSummary& one : eval::summarize(scene, seconds)) {
        const eval::Spread& error = one.equal_time.error;
        const std::string range = fmt::format("({:.2e} .. {:.2e})", error.least, error.greatest);
        const std::string factor =
            one.speed_up ? fmt::format("{}{:.3g}x", one.speed_up->extrapolated ? "~" : "",
                                       one.speed_up->factor)
                         : "-";
        result +=
            fmt::format("  {:<6}{:>8}{:>11.2e}{:>24}{:>12.3g}{:>12}{:>9}{:>10}{}\n",
                        to_name(one.integrator), one.equal_time.samples, error.median, range,
                        one.efficiency, factor, flip_text(one.flip), flip_text(one.denoised_flip),
                        one.equal_time.near_noise ? "  reference too noisy"
                        : one.floor               ? "  cannot find all light"
                                                  : "");
    }
    return result;
}

namespace {

using eval::ComparisonReport;

constexpr std::array<const char*, 4> channel_names{"red", "green", "blue", "mean"};

std::string optional_text(const std::optional<double>& value)
{
    return value ? fmt::format("{:.4g}", *value) : "-";
}

std::string metrics_text(const ComparisonReport& report)
{
    const bool seeds = report.images.size() > 1;
    std::string result = seeds ? fmt::format("{:<10}{:>12}{:>12}{:>12}{:>12}\n", "metric", "mean",
                                             "deviation", "least", "greatest")
                               : fmt::format("{:<10}{:>12}\n", "metric", "value");
    for (const eval::MetricSummary& metric : report.metrics) {
        const std::string_view name = to_string(metric.metric);
        result += fmt::format("{:<10}{:>12.6g}", name, metric.mean);
        if (seeds) {
            result += fmt::format("{:>12}{:>12.6g}{:>12.6g}", optional_text(metric.deviation),
                                  metric.least, metric.greatest);
        }
        result += metric.metric == eval::Metric::psnr
                      ? fmt::format("  dB, peak {:.4g}\n", report.scale.peak)
                      : "\n";
    }
    return result;
}

std::string bias_text(const ComparisonReport& report)
{
    const eval::Bias& bias = report.bias;
    std::string result = fmt::format("{:<10}{:>12}{:>18}\n", "bias", "value", "standard error");
    for (std::size_t c = 0; c < channel_names.size(); ++c) {
        result += fmt::format("{:<10}{:>12.4g}{:>18}\n", channel_names[c], bias.channels[c].value,
                              optional_text(bias.channels[c].standard_error));
    }
    if (bias.source == eval::BiasSource::blocks) {
        return result + "(from blocks of one image; a folder of seeds tells more)\n";
    }
    return result + fmt::format("standard error of a pixel {}, of a tile {}\n",
                                optional_text(bias.pixel_standard_error),
                                optional_text(bias.tile_standard_error));
}

std::string tiles_text(const ComparisonReport& report)
{
    std::string result = fmt::format("worst tiles of {0} x {0} by {1}\n", report.tile_size,
                                     to_string(report.map_metric));
    for (const eval::TileError& tile : report.worst_tiles) {
        result += fmt::format("  {:<24}{:>12.4g}\n", option_text(tile.tile), tile.value);
    }
    if (report.biased_tiles.empty()) {
        return result;
    }
    result += fmt::format("\n{:<26}{:<8}{:>12}{:>16}{:>8}{:>10}\n", "tiles by bias", "channel",
                          "bias", "standard error", "t", "p (Holm)");
    for (const eval::TileBias& tile : report.biased_tiles) {
        result += fmt::format("  {:<24}{:<8}{:>12.4g}{:>16.4g}{:>8.3g}{:>10.3g}\n",
                              option_text(tile.tile),
                              channel_names[static_cast<std::size_t>(tile.channel)], tile.bias,
                              tile.standard_error, tile.t, tile.p);
    }
    return result;
}

}  // namespace

std::string compare_text(const ComparisonReport& report,
                         std::span<const eval::ThresholdResult> thresholds)
{
    const std::size_t count = report.images.size();
    std::string result = fmt::format("{} of {} x {} pixels\n\n{}\n{}\n{}",
                                     count == 1 ? "1 image" : fmt::format("{} images", count),
                                     report.region.width(), report.region.height(),
                                     metrics_text(report), bias_text(report), tiles_text(report));
    for (const eval::ThresholdResult& threshold : thresholds) {
        result +=
            fmt::format("{}threshold {}={:.6g}: {} with {:.6g}\n",
                        &threshold == thresholds.data() ? "\n" : "", threshold.name,
                        threshold.limit, threshold.passed ? "passed" : "failed", threshold.value);
    }
    return result;
}

namespace {

using eval::IntegratorFinding;
using eval::MeanComparison;
using eval::StrategyFinding;
using eval::VerifyReport;

std::string percent(double fraction)
{
    return std::isfinite(fraction) ? fmt::format("{:.3g} %", 100.0 * fraction) : "-";
}

/// Formats the fraction `part` of `all`.
std::string percent(double part, double all)
{
    return all > 0.0 ? percent(part / all) : "-";
}

std::string images_text(const VerifyReport& report)
{
    std::string result = fmt::format("{:<11}{:>12}{:>16}{:>10}\n", "integrator", "mean [nit]",
                                     "standard error", "defects");
    for (const eval::ImageFinding& image : report.images) {
        result += fmt::format("{:<11}{:>12.6g}{:>16.2g}{:>10}\n", to_name(image.integrator),
                              image.radiance, image.error,
                              image.defects.invalid + image.defects.saturated);
    }
    return result;
}

std::string lengths_text(const VerifyReport& report)
{
    std::string result = fmt::format("\n{:<8}{:>12}{:>12}{:>18}{:>16}\n", "edges", "of the light",
                                     "error", "pt, nee, mis see", "lt sees");
    for (const eval::LengthFinding& length : report.lengths) {
        result += fmt::format("{:<8}{:>12}{:>12}{:>18}{:>16}\n", length.edges,
                              percent(length.radiance, report.radiance),
                              percent(length.error, length.radiance),
                              percent(length.seen_from_camera), percent(length.seen_from_light));
    }
    return result;
}

std::string comparison_text(const MeanComparison& test)
{
    return fmt::format("{:>12}{:>12}{:>8.2f}{:>10.2g}",
                       percent(test.found - test.expected, test.expected),
                       percent(test.error, test.expected), test.z, test.p_adjusted);
}

constexpr const char* comparison_head = "  difference       error       z  p (Holm)";

std::string strategies_text(const VerifyReport& report)
{
    std::string result = fmt::format("\n{:<10}{:>10}{:>12}{:>12}{}\n", "strategy", "brings",
                                     "alone finds", "cannot see", comparison_head);
    for (const StrategyFinding& finding : report.strategies) {
        const auto [s, t] = finding.strategy;
        if (finding.unweighted == 0.0 && finding.whole.expected == 0.0) {
            continue;  // has no paths of this length
        }
        const double all = report.lengths[static_cast<std::size_t>(s + t - 2)].radiance;
        result += fmt::format("{:<10}{:>10}{:>12}{:>12}{}\n", fmt::format("s={} t={}", s, t),
                              percent(finding.weighted, report.radiance),
                              percent(finding.unweighted, all), percent(finding.blind),
                              comparison_text(finding.whole));
    }
    return result;
}

std::string integrators_text(const VerifyReport& report)
{
    std::string result = fmt::format("\n{:<14}{:<8}{}\n", "against bdpt", "edges", comparison_head);
    for (const IntegratorFinding& finding : report.integrators) {
        if (finding.whole.found == 0.0 && finding.whole.expected == 0.0) {
            continue;
        }
        result += fmt::format("{:<14}{:<8}{}\n", to_name(finding.integrator), finding.edges,
                              comparison_text(finding.whole));
    }
    return result;
}

std::string merges_text(const VerifyReport& report)
{
    if (report.merges.empty()) {
        return {};
    }
    std::string result = fmt::format("\n{:<10}{:>10}{}\n", "merging", "brings", comparison_head);
    for (const eval::MergeFinding& finding : report.merges) {
        if (finding.whole.found != 0.0 || finding.whole.expected != 0.0) {
            result += fmt::format("{:<10}{:>10}{}\n", fmt::format("{} edges", finding.edges),
                                  percent(finding.brought, report.radiance),
                                  comparison_text(finding.whole));
        }
    }
    return result;
}

/// Returns the total contribution of merging to the image of vcm [nit].
double merged_light(const VerifyReport& report)
{
    double sum = 0.0;
    for (const eval::MergeFinding& finding : report.merges) {
        sum += finding.brought;
    }
    return sum;
}

void add_failures(const std::string& name, const MeanComparison& whole,
                  const std::vector<MeanComparison>& channels,
                  const std::vector<MeanComparison>& tiles, const VerifyReport& report,
                  std::vector<std::string>& lines)
{
    constexpr std::array channel_names{"red", "green", "blue"};
    const auto line = [&](const std::string& where, const MeanComparison& test) {
        return fmt::format("{}, {}: {:.6g} nit, but {:.6g} expected (z = {:.2f}, p = {:.2g})", name,
                           where, test.found, test.expected, test.z, test.p_adjusted);
    };
    if (fails(whole, report)) {
        lines.push_back(line("whole image", whole));
    }
    for (std::size_t i = 0; i < channels.size(); ++i) {
        if (fails(channels[i], report)) {
            lines.push_back(
                line(fmt::format("{} of the whole image", channel_names[i]), channels[i]));
        }
    }
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        if (fails(tiles[i], report)) {
            lines.push_back(line("tile " + option_text(report.tiles[i]), tiles[i]));
        }
    }
}

std::vector<std::string> failures(const VerifyReport& report)
{
    std::vector<std::string> lines;
    for (const eval::ImageFinding& image : report.images) {
        if (const auto& place = image.defects.first_invalid) {
            lines.push_back(fmt::format(
                "{}: {} contributions were NaN, infinite or negative; the first at pixel ({}, {}), "
                "sample {}",
                to_name(image.integrator), image.defects.invalid, place->x, place->y,
                place->sample_index));
        }
        if (image.defects.saturated > 0) {
            lines.push_back(fmt::format("{}: {} contributions were too large for the film",
                                        to_name(image.integrator), image.defects.saturated));
        }
        if (loses_light(image)) {
            lines.push_back(fmt::format("{}: the paths and the image of a tile differ by {}",
                                        to_name(image.integrator), percent(image.lost)));
        }
    }
    if (report.weights.wrong > 0) {
        lines.push_back(fmt::format(
            "weights: {} of {} paths have a weight that differs from its definition, by up to "
            "{:.3g}: the weights of all strategies do not sum to one",
            report.weights.wrong, report.weights.paths, report.weights.worst));
    }
    for (const StrategyFinding& finding : report.strategies) {
        add_failures(fmt::format("strategy s={} t={}", finding.strategy.s, finding.strategy.t),
                     finding.whole, finding.channels, finding.tiles, report, lines);
    }
    for (const IntegratorFinding& finding : report.integrators) {
        add_failures(
            fmt::format("{} against bdpt, {} edges", to_name(finding.integrator), finding.edges),
            finding.whole, finding.channels, finding.tiles, report, lines);
    }
    for (const eval::MergeFinding& finding : report.merges) {
        add_failures(fmt::format("merging, {} edges", finding.edges), finding.whole,
                     finding.channels, {}, report, lines);
    }
    return lines;
}

/// Describes the strategies whose noise could hide the greatest error.
std::string noisiest(const VerifyReport& report)
{
    const auto worst = std::max_element(
        report.strategies.begin(), report.strategies.end(),
        [](const auto& a, const auto& b) { return a.whole.detectable < b.whole.detectable; });
    return fmt::format("s={} t={}", worst->strategy.s, worst->strategy.t);
}

std::string verdict_text(const VerifyReport& report, const eval::VerifyOptions& options)
{
    if (report.verdict == eval::Verdict::fail) {
        constexpr std::size_t max_lines = 20;
        const std::vector<std::string> lines = failures(report);
        std::string result = "\n";
        for (std::size_t i = 0; i < std::min(lines.size(), max_lines); ++i) {
            result += lines[i] + "\n";
        }
        if (lines.size() > max_lines) {
            result += fmt::format("and {} more\n", lines.size() - max_lines);
        }
        return result + "FAIL: the estimators disagree\n";
    }
    if (!(report.radiance > 0.0)) {
        return "\nINCONCLUSIVE: no light reaches the camera\n";
    }
    if (report.verdict == eval::Verdict::inconclusive && !std::isfinite(report.detectable)) {
        return "\nINCONCLUSIVE: nothing disagrees, but there are too few samples to tell which "
               "error would be found. Use more --time\n";
    }
    const std::string found = fmt::format(
        "errors of a strategy that change the image, or a channel of it, by {} would have been "
        "found with 90 % probability",
        percent(report.detectable));
    if (!report.merges.empty() && report.verdict == eval::Verdict::inconclusive &&
        report.detectable <= options.detectable_bias) {
        return fmt::format(
            "\nINCONCLUSIVE: nothing disagrees, but {}; {} is needed. Use more --time, or a larger "
            "--merge-radius\n",
            std::isfinite(report.detectable_of_merging)
                ? fmt::format(
                      "of merging only an error by {} of its contribution would have been found",
                      percent(report.detectable_of_merging))
                : "no other strategy finds the light that is merged here",
            percent(eval::max_error_of_merging));
    }
    if (report.verdict == eval::Verdict::inconclusive) {
        return fmt::format(
            "\nINCONCLUSIVE: nothing disagrees, but only {}; {} was asked for. The noisiest is {}. "
            "Use more --time\n",
            found, percent(options.detectable_bias), noisiest(report));
    }
    const std::string merging =
        report.merges.empty()
            ? ""
            : fmt::format(
                  "; merging contributes {} of the image, and an error by {} of that would have "
                  "been",
                  percent(merged_light(report), report.radiance),
                  percent(report.detectable_of_merging));
    return fmt::format("\nPASS: all agree; {}{}\n", found, merging);
}

}  // namespace

std::string verify_text(const VerifyReport& report, const eval::VerifyOptions& options)
{
    std::string result = fmt::format(
        "{} batches in {:.1f} s, paths of up to {} edges; weights of {} paths checked, worst "
        "difference {:.2g}\n\n",
        report.batches, report.seconds, options.max_depth, report.weights.paths,
        report.weights.worst);
    result += images_text(report) + lengths_text(report) + strategies_text(report) +
              integrators_text(report) + merges_text(report);
    if (report.unchecked > 1e-6) {
        result += fmt::format(
            "\n{} of the light is found by one strategy of bdpt only, and not by pt, nee or mis: "
            "nothing checks it\n",
            percent(report.unchecked));
    }
    return result + verdict_text(report, options);
}

}  // namespace bdpt::app
