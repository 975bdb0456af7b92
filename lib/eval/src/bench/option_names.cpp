#include <bdpt/eval/bench/option_names.h>
#include <bdpt/integrators.h>

#include <algorithm>

namespace bdpt::eval {

namespace {

template <typename Values>
auto parse(const Values& values, std::string_view name)
{
    const auto found = std::find_if(values.begin(), values.end(),
                                    [name](auto value) { return to_string(value) == name; });
    return found == values.end() ? std::nullopt : std::optional(*found);
}

}  // namespace

std::vector<IntegratorKind> all_integrators()
{
    std::vector<IntegratorKind> kinds;
    for (const IntegratorInfo& integrator : integrators()) {
        kinds.push_back(integrator.kind);
    }
    return kinds;
}

std::vector<IntegratorKind> unbiased_integrators()
{
    std::vector<IntegratorKind> kinds = all_integrators();
    std::erase_if(kinds, [](IntegratorKind kind) { return info(kind).biased; });
    return kinds;
}

std::string_view to_string(IntegratorKind kind)
{
    return info(kind).name;
}

std::string_view to_string(Heuristic heuristic)
{
    switch (heuristic) {
        case Heuristic::balance:
            return "balance";
        case Heuristic::power:
            return "power";
        case Heuristic::cutoff:
            return "cutoff";
        case Heuristic::maximum:
            return "maximum";
        case Heuristic::uniform:
            break;
    }
    return "uniform";
}

std::optional<IntegratorKind> parse_integrator(std::string_view name)
{
    return parse(all_integrators(), name);
}

std::optional<Heuristic> parse_heuristic(std::string_view name)
{
    return parse(all_heuristics, name);
}

}  // namespace bdpt::eval
