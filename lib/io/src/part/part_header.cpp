#include <bdpt/error.h>
#include <bdpt/fields.h>
#include <bdpt/io/json_value.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "part/json_values.h"
#include "part/part_contents.h"

namespace bdpt::io {

using nlohmann::ordered_json;

ordered_json ids_to_json(const IdNames& names, const IdRanks& ranks)
{
    ordered_json json = ordered_json::array();
    for (std::size_t kind = 0; kind < id_kinds.size(); ++kind) {
        ordered_json list = ordered_json::array();
        for (const NamedId& name : names[kind]) {
            list.push_back(ordered_json::array({name.name, static_cast<std::uint32_t>(name.id)}));
        }
        json.push_back({{"ranks", ranks[kind]}, {"names", std::move(list)}});
    }
    return json;
}

namespace {

/// Returns the number of kinds of ids in a file: older ones lack the last.
std::size_t count_kinds(const JsonValue& json)
{
    return std::min(json.elements().size(), id_kinds.size());
}

}  // namespace

IdNames names_from_json(const JsonValue& json)
{
    IdNames names;
    for (std::size_t kind = 0; kind < count_kinds(json); ++kind) {
        for (const JsonValue& pair : json.at(kind).at("names").elements()) {
            const NameId id{pair.at(1).number<std::uint32_t>()};
            if (!is_name_id(id)) {
                pair.at(1).fail_expecting("the id of a name");
            }
            names[kind].push_back({.name = pair.at(0).text(), .id = id});
        }
    }
    return names;
}

IdRanks ranks_from_json(const JsonValue& json)
{
    IdRanks ranks{};
    for (std::size_t kind = 0; kind < count_kinds(json); ++kind) {
        ranks[kind] = static_cast<std::size_t>(json.at(kind).at("ranks").number<std::uint32_t>());
    }
    return ranks;
}

namespace {

using nlohmann::ordered_json;

constexpr int format = 1;
constexpr int max_side = 1 << 16;       // [pixels]
constexpr int max_vertices = 4096 + 1;  // maximum of a strategy, on one side
constexpr double max_seconds = 1e12;    // render time, summed over all machines

SampleSet read_samples(const JsonValue& json)
{
    const auto set = SampleSet::parse(json.text());
    if (!set) {
        json.fail_expecting("ranges of samples in ascending order, like 0:64,128:192");
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

FilmLayout read_layout(const JsonValue& json)
{
    FilmLayout layout{
        .width = json.at("size").at(0).number(1, max_side),
        .height = json.at("size").at(1).number(1, max_side),
        .region = {},
        .splats = json.at("splats").boolean() ? SplatImage::present : SplatImage::absent};
    const JsonValue region = json.at("region");
    layout.region.x0 = region.at(0).number(0, layout.width - 1);
    layout.region.y0 = region.at(1).number(0, layout.height - 1);
    layout.region.x1 = region.at(2).number(layout.region.x0 + 1, layout.width);
    layout.region.y1 = region.at(3).number(layout.region.y0 + 1, layout.height);
    if (const JsonValue clamp = json.at("clamp"); !clamp.is_null()) {
        layout.clamp = clamp.number<float>(std::numeric_limits<float>::denorm_min());
    }
    return layout;
}

ordered_json to_json(const AovSet& aovs)
{
    ordered_json json = ordered_json::array();
    for (const AovLayer& layer : aov_layers) {
        if (aovs.contains(layer.aov)) {
            json.push_back(static_cast<int>(layer.aov));
        }
    }
    return json;
}

AovSet read_aovs(const JsonValue& json)
{
    AovSet aovs;
    for (const JsonValue& number : json.elements()) {
        aovs.insert(static_cast<Aov>(number.number(0, static_cast<int>(aov_layers.size()) - 1)));
    }
    return aovs;
}

/// Checks the numbers of ids: no pixel has more than there are names, or samples; kinds that were
/// not requested have none.
void check_ids(const PartHeader& header, const JsonValue& json)
{
    for (std::size_t kind = 0; kind < id_kinds.size(); ++kind) {
        const auto most = std::min<std::uint64_t>(
            header.names[kind].size(), static_cast<std::uint64_t>(header.samples.count()));
        if (header.ranks[kind] > (header.aovs.contains(id_aovs[kind]) ? most : 0)) {
            json.fail("more ids of a pixel than possible");
        }
    }
}

std::vector<Strategy> read_strategies(const JsonValue& json)
{
    std::vector<Strategy> strategies;
    for (const JsonValue& pair : json.elements()) {
        strategies.push_back(
            {.s = pair.at(0).number(0, max_vertices), .t = pair.at(1).number(0, max_vertices)});
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

FilmTotals read_totals(const JsonValue& json, const FilmLayout& layout)
{
    FilmTotals totals{.defects = {.invalid = json.at("invalid").number<std::uint64_t>(),
                                  .saturated = json.at("saturated").number<std::uint64_t>(),
                                  .first_invalid = {}}};
    if (json.has("first_invalid")) {
        const JsonValue place = json.at("first_invalid");
        constexpr std::int64_t max_index = std::numeric_limits<std::uint32_t>::max();
        totals.defects.first_invalid =
            FilmDefects::Place{.x = place.at(0).number(0, layout.width - 1),
                               .y = place.at(1).number(0, layout.height - 1),
                               .sample_index = place.at(2).number(std::int64_t{0}, max_index)};
    }
    const auto words = [&json](std::size_t i) {
        const JsonValue pair = json.at("clamped").at(i);
        return ExactSum::Words{.low = pair.at(0).number<std::uint64_t>(),
                               .high = pair.at(1).number<std::uint64_t>()};
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

RenderStats read_stats(const JsonValue& json)
{
    const auto count = [&json](std::size_t i) { return json.at(i).number<std::uint64_t>(); };
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
    if (metadata.origin != DVec3(0.0)) {
        json["origin"] = {metadata.origin.x, metadata.origin.y, metadata.origin.z};
    }
    for_each_field(metadata.camera, [&json](const auto& field, const auto& value) {
        json["camera"][std::string(field.name)] = value_to_json(value);
    });
    return json;
}

ImageMetadata read_metadata(const JsonValue& json)
{
    ImageMetadata metadata;
    metadata.version = json.at("version").text();
    metadata.scene = json.at("scene").text();
    metadata.settings = json.at("settings").text();
    metadata.integrator = json.at("integrator").text();
    metadata.seed = json.at("seed").number<std::uint64_t>();
    metadata.render_seconds = json.at("seconds").number(0.0, max_seconds);
    metadata.xmp = json.at("xmp").text();
    if (json.has("frame")) {
        const JsonValue frame = json.at("frame");
        constexpr double max_rate = 1e6;
        metadata.frame = FrameNumber{.number = frame.at(0).number<int>(),
                                     .per_second = frame.at(1).number(0.0, max_rate)};
    }
    if (json.has("origin")) {
        constexpr double most = 1e15;
        for (int axis = 0; axis < 3; ++axis) {
            metadata.origin[axis] =
                json.at("origin").at(static_cast<std::size_t>(axis)).number(-most, most);
        }
    }
    for_each_field(metadata.camera, [&json](const auto& field, auto& value) {
        if (json.at("camera").has(field.name)) {  // older files have fewer
            value_from_json(json.at("camera").at(field.name), value);
        }
    });
    return metadata;
}

PartHeader read(const JsonValue& json)
{
    const int found = json.at("format").number<int>();
    if (found != format) {
        throw Error(ErrorCode::invalid_input,
                    "is a part of format " + std::to_string(found) +
                        (found > format ? ", which a newer bdpt wrote" : "") +
                        "; this program reads format " + std::to_string(format));
    }
    PartHeader header;
    for (const auto& [name, value] : json.at("identity").members()) {
        header.identity.components.push_back({.name = name, .value = value.text()});
    }
    header.samples = read_samples(json.at("samples"));
    if (header.samples.empty()) {
        json.at("samples").fail("no samples");
    }
    header.layout = read_layout(json.at("film"));
    header.aovs = read_aovs(json.at("layers"));
    header.counts = json.has("own_counts") && json.at("own_counts").boolean() ? PixelCounts::own
                                                                              : PixelCounts::equal;
    if (asks_for_ids(header.aovs)) {
        const JsonValue ids = json.at("ids");
        header.names = names_from_json(ids);
        header.ranks = ranks_from_json(ids);
        check_ids(header, ids);
    }
    header.strategies = read_strategies(json.at("strategies"));
    header.totals = read_totals(json.at("totals"), header.layout);
    header.stats = read_stats(json.at("stats"));
    header.cpu_seconds = json.at("cpu_seconds").number(0.0, max_seconds);
    header.notes.goal = read_samples(json.at("goal"));
    header.notes.metadata = read_metadata(json.at("image"));
    header.notes.metadata.samples_per_pixel = header.samples.count();
    header.notes.command = json.at("command").texts();
    return header;
}

}  // namespace

PartHeader make_part_header(const RenderResult& part, const PartNotes& notes)
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
    // Names are unique; a search for each would take quadratic time.
    auto& identity = json["identity"].get_ref<ordered_json::object_t&>();
    for (const auto& [name, value] : header.identity.components) {
        identity.emplace_back(name, value);
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
        return read(JsonValue::parse(text));
    } catch (const Error& error) {
        throw Error(error.code(), std::string("its header is not that of a part: ") + error.what());
    }
}

RenderResult make_part(const PartHeader& header)
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
