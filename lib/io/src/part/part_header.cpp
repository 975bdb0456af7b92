#include "part/part_header.h"

#include <bdpt/error.h>
#include <bdpt/fields.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "part/id_json.h"
#include "part/json_values.h"

namespace bdpt::io {
namespace {

using nlohmann::ordered_json;

constexpr int format = 1;
constexpr int most_side = 1 << 16;       // [pixels]
constexpr int most_vertices = 4096 + 1;  // of a strategy, from one side

template <typename Number>
Number checked(Number value, Number low, Number high)
{
    if (!(value >= low && value <= high)) {
        throw std::runtime_error("a number out of range");
    }
    return value;
}

SampleSet read_samples(const ordered_json& json)
{
    const auto set = SampleSet::parse(json.get_ref<const std::string&>());
    if (!set) {
        throw std::runtime_error("a set of samples that is none");
    }
    return *set;
}

ordered_json to_json(const FilmLayout& layout)
{
    const PixelRect& r = layout.region;
    ordered_json json{{"size", {layout.width, layout.height}},
                      {"region", {r.x0, r.y0, r.x1, r.y1}},
                      {"splats", layout.splats == SplatImage::present}};
    json["clamp"] = std::isfinite(layout.clamp) ? ordered_json(layout.clamp) : ordered_json();
    return json;
}

FilmLayout read_layout(const ordered_json& json)
{
    FilmLayout layout{
        .width = checked(json.at("size").at(0).get<int>(), 1, most_side),
        .height = checked(json.at("size").at(1).get<int>(), 1, most_side),
        .region = {},
        .splats = json.at("splats").get<bool>() ? SplatImage::present : SplatImage::absent};
    const ordered_json& region = json.at("region");
    layout.region.x0 = checked(region.at(0).get<int>(), 0, layout.width - 1);
    layout.region.y0 = checked(region.at(1).get<int>(), 0, layout.height - 1);
    layout.region.x1 = checked(region.at(2).get<int>(), layout.region.x0 + 1, layout.width);
    layout.region.y1 = checked(region.at(3).get<int>(), layout.region.y0 + 1, layout.height);
    if (!json.at("clamp").is_null()) {
        layout.clamp = json.at("clamp").get<float>();
    }
    return layout;
}

constexpr std::array all_aovs{Aov::albedo,       Aov::normal,   Aov::depth, Aov::position,
                              Aov::sample_count, Aov::variance, Aov::alpha, Aov::shadow,
                              Aov::object,       Aov::material};

ordered_json to_json(const AovSet& aovs)
{
    ordered_json json = ordered_json::array();
    for (const Aov aov : all_aovs) {
        if (aovs.contains(aov)) {
            json.push_back(static_cast<int>(aov));
        }
    }
    return json;
}

AovSet read_aovs(const ordered_json& json)
{
    AovSet aovs;
    for (const ordered_json& number : json) {
        aovs.insert(
            static_cast<Aov>(checked(number.get<int>(), 0, static_cast<int>(all_aovs.back()))));
    }
    return aovs;
}

/// No pixel has more ids than there are names, or samples; kinds that were not asked for have none.
void check_ids(const PartHeader& header)
{
    for (std::size_t kind = 0; kind < id_kinds.size(); ++kind) {
        const auto most = std::min<std::uint64_t>(
            header.names[kind].size(), static_cast<std::uint64_t>(header.samples.count()));
        if (header.ranks[kind] > (header.aovs.contains(id_aovs[kind]) ? most : 0)) {
            throw std::runtime_error("more ids of a pixel than there can be");
        }
    }
}

std::vector<Strategy> read_strategies(const ordered_json& json)
{
    std::vector<Strategy> strategies;
    for (const ordered_json& pair : json) {
        strategies.push_back({.s = checked(pair.at(0).get<int>(), 0, most_vertices),
                              .t = checked(pair.at(1).get<int>(), 0, most_vertices)});
    }
    return strategies;
}

ordered_json to_json(const FilmTotals& totals)
{
    const FilmDefects& defects = totals.defects;
    ordered_json json{{"invalid", defects.invalid}, {"saturated", defects.saturated}};
    if (const auto& place = defects.first_invalid) {
        json["first_invalid"] = {place->x, place->y, place->sample_index};
    }
    for (const auto& words :
         {totals.clamped[0], totals.clamped[1], totals.clamped[2], totals.clamped_contributions}) {
        json["clamped"].push_back({words.low, words.high});
    }
    return json;
}

FilmTotals read_totals(const ordered_json& json, const FilmLayout& layout)
{
    FilmTotals totals{.defects = {.invalid = json.at("invalid").get<std::uint64_t>(),
                                  .saturated = json.at("saturated").get<std::uint64_t>(),
                                  .first_invalid = {}}};
    if (json.contains("first_invalid")) {
        const ordered_json& place = json.at("first_invalid");
        constexpr std::int64_t most = std::numeric_limits<std::uint32_t>::max();
        totals.defects.first_invalid = FilmDefects::Place{
            .x = checked(place.at(0).get<int>(), 0, layout.width - 1),
            .y = checked(place.at(1).get<int>(), 0, layout.height - 1),
            .sample_index = checked(place.at(2).get<std::int64_t>(), std::int64_t{0}, most)};
    }
    const auto words = [&json](std::size_t i) {
        const ordered_json& pair = json.at("clamped").at(i);
        return ExactSum::Words{.low = pair.at(0).get<std::uint64_t>(),
                               .high = pair.at(1).get<std::uint64_t>()};
    };
    totals.clamped = {words(0), words(1), words(2)};
    totals.clamped_contributions = words(3);
    return totals;
}

ordered_json to_json(const RenderStats& stats)
{
    return {stats.rays.camera,         stats.rays.light,
            stats.rays.shadow,         stats.rays.aov,
            stats.paths.camera,        stats.paths.light,
            stats.rays.shadow_to_lens, stats.rays.shadow_interior};
}

RenderStats read_stats(const ordered_json& json)
{
    const auto count = [&json](std::size_t i) { return json.at(i).get<std::uint64_t>(); };
    return {.rays = {.camera = count(0),
                     .light = count(1),
                     .shadow = count(2),
                     .aov = count(3),
                     .shadow_to_lens = count(6),
                     .shadow_interior = count(7)},
            .paths = {.camera = count(4), .light = count(5)}};
}

ordered_json to_json(const ImageMetadata& metadata)
{
    ordered_json json{{"version", metadata.version},
                      {"scene", metadata.scene},
                      {"settings", metadata.settings},
                      {"integrator", metadata.integrator},
                      {"seed", metadata.seed},
                      {"seconds", metadata.render_seconds},
                      {"xmp", metadata.xmp}};
    if (metadata.frame) {
        json["frame"] = {metadata.frame->number, metadata.frame->per_second};
    }
    for_each_field(metadata.camera, [&json](const auto& field, const auto& value) {
        json["camera"][std::string(field.name)] = value_to_json(value);
    });
    return json;
}

ImageMetadata read_metadata(const ordered_json& json)
{
    ImageMetadata metadata;
    metadata.version = json.at("version").get<std::string>();
    metadata.scene = json.at("scene").get<std::string>();
    metadata.settings = json.at("settings").get<std::string>();
    metadata.integrator = json.at("integrator").get<std::string>();
    metadata.seed = json.at("seed").get<std::uint64_t>();
    metadata.render_seconds = json.at("seconds").get<double>();
    metadata.xmp = json.at("xmp").get<std::string>();
    if (json.contains("frame")) {
        const ordered_json& frame = json.at("frame");
        constexpr double most = 1e6;
        metadata.frame = FrameNumber{.number = frame.at(0).get<int>(),
                                     .per_second = checked(frame.at(1).get<double>(), 0.0, most)};
    }
    for_each_field(metadata.camera, [&json](const auto& field, auto& value) {
        value_from_json(json.at("camera").at(std::string(field.name)), value);
    });
    checked(static_cast<int>(metadata.camera.projection), 0,
            static_cast<int>(Projection::orthographic));
    return metadata;
}

PartHeader read(const ordered_json& json)
{
    if (json.at("format").get<int>() != format) {
        throw Error(ErrorCode::invalid_input, "is a part of format " + json.at("format").dump() +
                                                  "; this program reads " + std::to_string(format));
    }
    PartHeader header;
    for (const auto& [name, value] : json.at("identity").items()) {
        header.identity.components.push_back({.name = name, .value = value.get<std::string>()});
    }
    header.samples = read_samples(json.at("samples"));
    if (header.samples.empty()) {
        throw std::runtime_error("no samples");
    }
    header.layout = read_layout(json.at("film"));
    header.aovs = read_aovs(json.at("layers"));
    header.counts = json.value("own_counts", false) ? PixelCounts::own : PixelCounts::equal;
    if (asks_for_ids(header.aovs)) {
        const ordered_json& ids = json.at("ids");
        header.names = names_from_json(ids);
        header.ranks = ranks_from_json(ids);
        check_ids(header);
    }
    header.strategies = read_strategies(json.at("strategies"));
    header.totals = read_totals(json.at("totals"), header.layout);
    header.stats = read_stats(json.at("stats"));
    header.cpu_seconds = json.at("cpu_seconds").get<double>();
    header.notes.goal = read_samples(json.at("goal"));
    header.notes.metadata = read_metadata(json.at("image"));
    header.notes.metadata.samples_per_pixel = header.samples.count();
    header.notes.command = json.at("command").get<std::vector<std::string>>();
    return header;
}

}  // namespace

PartHeader header_of(const RenderPart& part, const PartNotes& notes)
{
    return {.identity = part.identity,
            .samples = part.samples,
            .layout = part.film.layout(),
            .aovs = part.aovs.aovs(),
            .counts = part.aovs.counts(),
            .names = part.ids.names(),
            .ranks = part.ids.ranks(),
            .strategies = part.strategies.strategies(),
            .totals = part.film.totals(),
            .stats = part.stats,
            .cpu_seconds = part.cpu_seconds,
            .notes = notes};
}

std::string to_text(const PartHeader& header)
{
    ordered_json json{{"format", format},
                      {"samples", header.samples.text()},
                      {"goal", header.notes.goal.text()},
                      {"identity", ordered_json::object()},
                      {"film", to_json(header.layout)},
                      {"layers", to_json(header.aovs)},
                      {"strategies", ordered_json::array()},
                      {"totals", to_json(header.totals)},
                      {"stats", to_json(header.stats)},
                      {"cpu_seconds", header.cpu_seconds},
                      {"image", to_json(header.notes.metadata)},
                      {"command", header.notes.command}};
    if (header.counts == PixelCounts::own) {
        json["own_counts"] = true;
    }
    if (asks_for_ids(header.aovs)) {
        json["ids"] = ids_to_json(header.names, header.ranks);
    }
    for (const auto& [name, value] : header.identity.components) {
        json["identity"][name] = value;
    }
    for (const auto& [s, t] : header.strategies) {
        json["strategies"].push_back({s, t});
    }
    // Names of files may be no UTF-8.
    return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

PartHeader parse_part_header(std::string_view text)
{
    try {
        return read(ordered_json::parse(text));
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw Error(ErrorCode::invalid_input,
                    std::string("what it says about itself is not of a part: ") + error.what());
    }
}

RenderPart make_part(const PartHeader& header)
{
    return {.identity = header.identity,
            .samples = {},
            .film = Film(header.layout),
            .aovs = AovFilm(header.layout.region, header.aovs, header.counts),
            .ids = IdFilm(header.layout.region, header.aovs, header.names),
            .strategies = StrategyFilm(header.layout.region, header.strategies),
            .stats = {}};
}

}  // namespace bdpt::io
