#include "part/id_json.h"

#include <cstddef>
#include <cstdint>
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

IdNames names_from_json(const JsonValue& json)
{
    IdNames names;
    for (std::size_t kind = 0; kind < id_kinds.size(); ++kind) {
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
    for (std::size_t kind = 0; kind < id_kinds.size(); ++kind) {
        ranks[kind] = static_cast<std::size_t>(json.at(kind).at("ranks").number<std::uint32_t>());
    }
    return ranks;
}

}  // namespace bdpt::io
