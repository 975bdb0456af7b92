#include "options/values/exposure.h"

#include <cmath>
#include <utility>

#include "options/values/value_types.h"

namespace bdpt::app {
namespace {

std::optional<float> parse_stops(const std::string& text)
{
    constexpr double most = 100.0;  // 2^100 is far beyond any ratio of a scene to a screen
    const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
    const std::optional<double> stops = decimal_number(has_plus ? text.substr(1) : text);
    return stops && std::abs(*stops) <= most ? std::optional(static_cast<float>(*stops))
                                             : std::nullopt;
}

}  // namespace

std::optional<Exposure> parse_exposure(const std::string& given)
{
    const std::string text = lower_case(given);
    for (const auto& [word, base] :
         {std::pair<std::string, ExposureBase>{"auto", ExposureBase::automatic},
          {"light", ExposureBase::light}}) {
        if (!text.starts_with(word)) {
            continue;
        }
        const std::string more = text.substr(word.size());
        if (more.empty()) {
            return Exposure{.base = base};
        }
        const std::optional<float> stops =
            more[0] == '+' || more[0] == '-' ? parse_stops(more) : std::nullopt;
        return stops ? std::optional(Exposure{.base = base, .value = *stops}) : std::nullopt;
    }
    const std::optional<float> stops = parse_stops(text);
    return stops ? std::optional(Exposure{.value = *stops}) : std::nullopt;
}

}  // namespace bdpt::app
