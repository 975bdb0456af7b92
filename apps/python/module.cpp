#include <bdpt/eval/metric.h>
#include <bdpt/version.h>
#include <fmt/core.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <map>
#include <string>
#include <vector>

#include "arrays.h"
#include "interpreter_lock.h"
#include "python_errors.h"
#include "python_scene.h"

namespace {

namespace nb = nanobind;

/// Waits for renders. Called when Python ends, before it destroys anything.
void wait_for_renders()
{
    PyThreadState* state = PyEval_SaveThread();
    bdpt::python::Workers::all().finish();
    PyEval_RestoreThread(state);
}

std::map<std::string, double> compare(const bdpt::python::ImageInput& image,
                                      const bdpt::python::ImageInput& reference,
                                      const std::vector<std::string>& metrics)
{
    const bdpt::Image left = to_image(image);
    const bdpt::Image right = to_image(reference);
    std::map<std::string, double> errors;
    for (const std::string& name : metrics) {
        const auto metric = bdpt::eval::parse_metric(name);
        if (!metric) {
            throw bdpt::python::ValueError(fmt::format("there is no metric {}", name));
        }
        const bdpt::python::Unlocked unlocked;
        errors[name] = evaluate(*metric, left, right);
    }
    return errors;
}

}  // namespace

NB_MODULE(_bdpt, module)
{
    module.doc() = "Bidirectional path tracing.";
    // Leak warnings are for developers, and daemon threads leak the objects they use.
    nb::set_leak_warnings(false);
    module.attr("__version__") = BDPT_VERSION;
    bdpt::python::bind_errors(module);
    nb::module_::import_("atexit").attr("register")(nb::cpp_function(&wait_for_renders));
    bdpt::python::bind_scene(module);
    bdpt::python::bind_parts_of_scenes(module);
    bdpt::python::bind_edits(module);
    bdpt::python::bind_scene_data(module);
    bdpt::python::bind_dataset(module);
    bdpt::python::bind_render(module);
    bdpt::python::bind_job(module);
    module.def("compare", &compare, nb::arg("image"), nb::arg("reference"),
               nb::arg("metrics") = std::vector<std::string>{"relmse", "flip"},
               "Errors of an image against a reference, by name of the metric: relmse, "
               "relmse_scales, mse, rmse, mape, smape, psnr, flip, flip_ldr. Arrays of float32 "
               "(height, width, 3).");
}
