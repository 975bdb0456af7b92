#pragma once

#include <bdpt/film/id_film.h>

#include <nlohmann/json.hpp>

namespace bdpt::io {

// What a part says about its ids: [{"ranks": 3, "names": [["lamp", 1083263012], ...]}, ...], for
// each kind. An id stands beside its name, as JSON changes names that are no UTF-8.

[[nodiscard]] nlohmann::ordered_json ids_to_json(const IdNames& names, const IdRanks& ranks);

/// Throws what nlohmann/json does, and `std::runtime_error` for ids that no name has.
[[nodiscard]] IdNames names_from_json(const nlohmann::ordered_json& json);

/// Throws what nlohmann/json does.
[[nodiscard]] IdRanks ranks_from_json(const nlohmann::ordered_json& json);

}  // namespace bdpt::io
