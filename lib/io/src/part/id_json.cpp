#include "part/id_json.h"

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

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

IdNames names_from_json(const ordered_json& json)
{
    IdNames names;
    for (std::size_t kind = 0; kind < id_kinds.size(); ++kind) {
        for (const ordered_json& pair : json.at(kind).at("names")) {
            const NameId id{pair.at(1).get<std::uint32_t>()};
            if (!is_name_id(id)) {
                throw std::runtime_error("an id that no name has");
            }
            names[kind].push_back({.name = pair.at(0).get<std::string>(), .id = id});
        }
    }
    return names;
}

IdRanks ranks_from_json(const ordered_json& json)
{
    IdRanks ranks{};
    for (std::size_t kind = 0; kind < id_kinds.size(); ++kind) {
        ranks[kind] = json.at(kind).at("ranks").get<std::size_t>();
    }
    return ranks;
}

}  // namespace bdpt::io
