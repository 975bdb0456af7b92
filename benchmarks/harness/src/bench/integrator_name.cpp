#include <bdpt/harness/bench/integrator_name.h>

namespace bdpt::harness {

std::string_view to_string(IntegratorKind kind)
{
    switch (kind) {
        case IntegratorKind::pt:
            return "pt";
        case IntegratorKind::mis:
            return "mis";
        case IntegratorKind::nee:
            return "nee";
        case IntegratorKind::lt:
            return "lt";
        case IntegratorKind::bdpt:
            break;
    }
    return "bdpt";
}

std::optional<IntegratorKind> parse_integrator(std::string_view name)
{
    for (const IntegratorKind kind : all_integrators) {
        if (to_string(kind) == name) {
            return kind;
        }
    }
    return std::nullopt;
}

}  // namespace bdpt::harness
