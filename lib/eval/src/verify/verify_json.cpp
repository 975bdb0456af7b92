#include <bdpt/eval/verify.h>
#include <bdpt/options/option_fields.h>

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "report/json_values.h"

namespace bdpt::eval {
namespace {

using nlohmann::ordered_json;

ordered_json to_json(const MeanComparison& test, const VerifyReport& report)
{
    return {{"found", number_or_null(test.found)},
            {"expected", number_or_null(test.expected)},
            {"error", number_or_null(test.error)},
            {"z", number_or_null(test.z)},
            {"p", test.p},
            {"p_adjusted", test.p_adjusted},
            {"failed", fails(test, report)}};
}

/// Returns the channels by name; empty if there are none.
ordered_json channels_json(const std::vector<MeanComparison>& channels, const VerifyReport& report)
{
    constexpr std::array names{"red", "green", "blue"};
    ordered_json object = ordered_json::object();
    for (std::size_t i = 0; i < channels.size(); ++i) {
        object[names[i]] = to_json(channels[i], report);
        object[names[i]]["detectable"] = number_or_null(channels[i].detectable);
    }
    return object;
}

/// Adds the tests of `finding`: a comparison of the whole image, one per channel, and one per tile.
template <typename Finding>
void add_tests(ordered_json& object, const Finding& finding, const VerifyReport& report)
{
    object["whole"] = to_json(finding.whole, report);
    object["whole"]["detectable"] = number_or_null(finding.whole.detectable);
    object["channels"] = channels_json(finding.channels, report);
    ordered_json tiles = ordered_json::array();
    for (std::size_t i = 0; i < finding.tiles.size(); ++i) {
        ordered_json tile = to_json(finding.tiles[i], report);
        tile["tile"] = rect_json(report.tiles[i]);
        tiles.push_back(std::move(tile));
    }
    object["tiles"] = std::move(tiles);
}

ordered_json to_json(const ImageFinding& image)
{
    ordered_json object{
        {"integrator", to_name(image.integrator)}, {"radiance", number_or_null(image.radiance)},
        {"error", number_or_null(image.error)},    {"invalid", image.defects.invalid},
        {"saturated", image.defects.saturated},    {"lost", number_or_null(image.lost)}};
    if (const auto& place = image.defects.first_invalid) {
        object["first_invalid"] = {
            {"x", place->x}, {"y", place->y}, {"sample", place->sample_index}};
    }
    return object;
}

}  // namespace

std::string_view to_string(Verdict verdict)
{
    constexpr std::array<std::string_view, 3> names{"pass", "fail", "inconclusive"};
    return names[static_cast<std::size_t>(verdict)];
}

std::string verify_json(const VerifyReport& report, std::string_view scene)
{
    ordered_json object{{"scene", scene},
                        {"verdict", to_string(report.verdict)},
                        {"batches", report.batches},
                        {"seconds", number_or_null(report.seconds)},
                        {"radiance", number_or_null(report.radiance)},
                        {"detectable", number_or_null(report.detectable)},
                        {"unchecked", number_or_null(report.unchecked)},
                        {"false_alarm", number_or_null(report.false_alarm)},
                        {"weights",
                         {{"paths", report.weights.paths},
                          {"wrong", report.weights.wrong},
                          {"worst", number_or_null(report.weights.worst)}}}};
    for (const ImageFinding& image : report.images) {
        object["integrators"].push_back(to_json(image));
    }
    for (const LengthFinding& length : report.lengths) {
        object["lengths"].push_back({{"edges", length.edges},
                                     {"radiance", number_or_null(length.radiance)},
                                     {"error", number_or_null(length.error)},
                                     {"seen_from_camera", number_or_null(length.seen_from_camera)},
                                     {"seen_from_light", number_or_null(length.seen_from_light)}});
    }
    for (const StrategyFinding& strategy : report.strategies) {
        ordered_json entry{{"s", strategy.strategy.s},
                           {"t", strategy.strategy.t},
                           {"blind", number_or_null(strategy.blind)},
                           {"weighted", number_or_null(strategy.weighted)},
                           {"unweighted", number_or_null(strategy.unweighted)},
                           {"solitary", number_or_null(strategy.solitary)}};
        add_tests(entry, strategy, report);
        object["strategies"].push_back(std::move(entry));
    }
    for (const IntegratorFinding& integrator : report.integrators) {
        ordered_json entry{{"integrator", to_name(integrator.integrator)},
                           {"edges", integrator.edges}};
        add_tests(entry, integrator, report);
        object["comparisons"].push_back(std::move(entry));
    }
    for (const MergeFinding& merges : report.merges) {
        ordered_json entry{{"edges", merges.edges},
                           {"brought", number_or_null(merges.brought)},
                           {"whole", to_json(merges.whole, report)},
                           {"channels", channels_json(merges.channels, report)}};
        object["merges"].push_back(std::move(entry));
    }
    if (!report.merges.empty()) {
        object["detectable_of_merging"] = number_or_null(report.detectable_of_merging);
    }
    return object.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace bdpt::eval
