#pragma once

#include <bdpt/film/id_film.h>
#include <bdpt/io/json_value.h>

#include <nlohmann/json.hpp>

namespace bdpt::io {

// What a part says about its ids: [{"ranks": 3, "names": [["lamp", 1083263012], ...]}, ...], for
// each kind. An id stands beside its name, as JSON changes names that are no UTF-8.

[[nodiscard]] nlohmann::ordered_json ids_to_json(const IdNames& names, const IdRanks& ranks);

/// Throws what `JsonValue` does, also for ids that no name has.
[[nodiscard]] IdNames names_from_json(const JsonValue& json);

/// Throws what `JsonValue` does.
[[nodiscard]] IdRanks ranks_from_json(const JsonValue& json);

}  // namespace bdpt::io
