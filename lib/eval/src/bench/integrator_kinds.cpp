#include <bdpt/eval/bench.h>
#include <bdpt/options/integrators.h>

namespace bdpt::eval {

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

}  // namespace bdpt::eval
