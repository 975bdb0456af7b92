#include <bdpt/error.h>
#include <bdpt/version.h>
#include <nanobind/nanobind.h>

#include <exception>

#include "interpreter_lock.h"
#include "python_scene.h"

namespace {

namespace nb = nanobind;

nb::object* error_type = nullptr;  // lives as long as the module

/// Translates bdpt::Error to bdpt.Error, whose `code` is the exit code of the command.
void translate(const std::exception_ptr& exception, void* /*payload*/)
{
    try {
        std::rethrow_exception(exception);
    } catch (const bdpt::Error& error) {
        nb::object raised = (*error_type)(error.what());
        raised.attr("code") = static_cast<int>(error.code());
        PyErr_SetObject(error_type->ptr(), raised.ptr());
    }
}

/// Waits for renders. Called when Python ends, before it destroys anything.
void wait_for_renders()
{
    PyThreadState* state = PyEval_SaveThread();
    bdpt::python::Workers::all().finish();
    PyEval_RestoreThread(state);
}

}  // namespace

NB_MODULE(_bdpt, module)
{
    module.doc() = "Bidirectional path tracing.";
    // Leak warnings are for developers, and daemon threads leak the objects they use.
    nb::set_leak_warnings(false);
    module.attr("__version__") = BDPT_VERSION;
    error_type = new nb::object(nb::steal(PyErr_NewExceptionWithDoc(
        "bdpt.Error",
        "Invalid input, or a failure of a library; `code` is the exit code of the command.",
        PyExc_RuntimeError, nullptr)));
    module.attr("Error") = *error_type;
    nb::register_exception_translator(translate);
    nb::module_::import_("atexit").attr("register")(nb::cpp_function(&wait_for_renders));
    bdpt::python::bind_scene(module);
    bdpt::python::bind_parts_of_scenes(module);
    bdpt::python::bind_edits(module);
    bdpt::python::bind_render(module);
    bdpt::python::bind_job(module);
    bdpt::python::bind_compare(module);
}
