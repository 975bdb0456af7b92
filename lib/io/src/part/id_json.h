#pragma once

#include <bdpt/film/id_film.h>
#include <bdpt/io/json_value.h>

#include <nlohmann/json.hpp>

namespace bdpt::io {

// JSON of a part's ids: [{"ranks": 3, "names": [["lamp", 1083263012], ...]}, ...], for each kind.
// Ids are stored beside their names, as JSON changes names that are not UTF-8.

[[nodiscard]] nlohmann::ordered_json ids_to_json(const IdNames& names, const IdRanks& ranks);

/// Parses names. Throws as `JsonValue` does, also for ids that no name has.
[[nodiscard]] IdNames names_from_json(const JsonValue& json);

/// Parses ranks. Throws as `JsonValue` does.
[[nodiscard]] IdRanks ranks_from_json(const JsonValue& json);

}  // namespace bdpt::io
