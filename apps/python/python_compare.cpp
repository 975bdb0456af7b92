#include <bdpt/error.h>
#include <bdpt/eval/metrics/metric.h>
#include <fmt/core.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <map>

#include "arrays.h"
#include "interpreter_lock.h"
#include "python_scene.h"

namespace bdpt::python {
namespace {

std::map<std::string, double> compare(const ImageInput& image, const ImageInput& reference,
                                      const std::vector<std::string>& metrics)
{
    const Image left = to_image(image);
    const Image right = to_image(reference);
    std::map<std::string, double> errors;
    for (const std::string& name : metrics) {
        const auto metric = eval::parse_metric(name);
        if (!metric) {
            throw Error(ErrorCode::usage, fmt::format("there is no metric {}", name));
        }
        const Unlocked unlocked;
        errors[name] = evaluate(*metric, left, right);
    }
    return errors;
}

}  // namespace

void bind_compare(nb::module_& module)
{
    module.def("compare", &compare, nb::arg("image"), nb::arg("reference"),
               nb::arg("metrics") = std::vector<std::string>{"relmse", "flip"},
               "Errors of an image against a reference, by name of the metric: relmse, "
               "relmse_scales, mse, rmse, mape, smape, psnr, flip, flip_ldr. Arrays of float32 "
               "(height, width, 3).");
}

}  // namespace bdpt::python
