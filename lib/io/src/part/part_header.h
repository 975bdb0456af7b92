#pragma once

#include <bdpt/aov.h>
#include <bdpt/film/film.h>
#include <bdpt/film/id_film.h>
#include <bdpt/io/part_file.h>
#include <bdpt/part/render_part.h>
#include <bdpt/render_stats.h>

#include <string>
#include <string_view>
#include <vector>

namespace bdpt::io {

/// All that a part file holds but its sums: its JSON.
struct PartHeader {
    Identity identity;
    SampleSet samples;
    FilmLayout layout;
    AovSet aovs;
    PixelCounts counts = PixelCounts::equal;
    IdNames names;    ///< of the AOVs that are images of ids
    IdRanks ranks{};  ///< that the file has planes for
    std::vector<Strategy> strategies;
    FilmTotals totals;
    RenderStats stats;
    double cpu_seconds = 0.0;
    PartNotes notes;
};

[[nodiscard]] PartHeader header_of(const RenderPart& part, const PartNotes& notes);

[[nodiscard]] std::string to_text(const PartHeader& header);

/// Throws `Error` (invalid_input) for what no part has.
[[nodiscard]] PartHeader parse_part_header(std::string_view text);

/// A part without samples that has films for what `header` describes.
[[nodiscard]] RenderPart make_part(const PartHeader& header);

}  // namespace bdpt::io
