#pragma once

#include <bdpt/aov.h>
#include <bdpt/film/film.h>
#include <bdpt/film/id_film.h>
#include <bdpt/io/part_file.h>
#include <bdpt/part/render_result.h>
#include <bdpt/render_stats.h>

#include <string>
#include <string_view>
#include <vector>

namespace bdpt::io {

/// The contents of a part file except its sums: its JSON.
struct PartHeader {
    Identity identity;
    SampleSet samples;
    FilmLayout layout;
    AovSet aovs;
    PixelCounts counts = PixelCounts::equal;
    IdNames names;    ///< names in the AOVs that are images of ids
    IdRanks ranks{};  ///< ranks that the file has planes for
    std::vector<Strategy> strategies;
    FilmTotals totals;
    RenderStats stats;
    double cpu_seconds = 0.0;
    PartNotes notes;
};

[[nodiscard]] PartHeader make_part_header(const RenderResult& part, const PartNotes& notes);

[[nodiscard]] std::string to_text(const PartHeader& header);

/// Parses a header. Throws `Error` (invalid_input) for anything that no part has.
[[nodiscard]] PartHeader parse_part_header(std::string_view text);

/// Creates a part without samples that has films as `header` describes.
[[nodiscard]] RenderResult make_part(const PartHeader& header);

}  // namespace bdpt::io
