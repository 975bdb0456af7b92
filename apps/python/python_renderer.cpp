#include <bdpt/renderer.h>
#include <nanobind/stl/string.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "arrays.h"
#include "interpreter_lock.h"
#include "python_render.h"

namespace bdpt::python {
namespace {

/// A `bdpt::Renderer`, and the data that a `Render` of its samples needs.
class PythonRenderer {
public:
    explicit PythonRenderer(Task asked) : task_(std::move(asked)), result_(empty_render(task_))
    {
        const Unlocked unlocked;
        renderer_.emplace(task_.stage.scene, task_.stage.camera, task_.arguments.options);
    }

    void render(std::int64_t samples, const nb::object& progress)
    {
        const RenderControl control = make_control(progress, {});
        const Unlocked unlocked;
        renderer_->render(samples, control);
    }

    void finish(const nb::object& progress)
    {
        const RenderControl control = make_control(progress, task_.arguments.goal);
        const Unlocked unlocked;
        renderer_->finish(control);
    }

    void add(const Render& other)
    {
        const Unlocked unlocked;
        *renderer_ += other.part;
    }

    [[nodiscard]] const bdpt::Renderer& renderer() const { return *renderer_; }

    /// Moves all samples out.
    [[nodiscard]] Render take()
    {
        return {.part = renderer_->take(),
                .notes = result_.notes,
                .backdrop = result_.backdrop,
                .inputs = result_.inputs};
    }

    /// Returns the result of `look` on all samples, which are moved back.
    template <typename Look>
    auto look_at_result(const Look& look)
    {
        const Render render = take();
        const struct Return {
            PythonRenderer& self;
            const Render& render;
            ~Return() { self.add(render); }
        } at_the_end{*this, render};
        return look(render);
    }

private:
    Task task_;
    Render result_;  // without samples
    std::optional<bdpt::Renderer> renderer_;
};

}  // namespace

void bind_renderer(nb::module_& module)
{
    const std::string making =
        declaration("def __init__(self, scene: Scene, *", Call::render, "None");
    const std::string text_of_making =
        documentation("Options are those of render(), which is what finish() makes.", Call::render);
    const std::string saving = declaration(saving_head, Call::save, "None");
    const std::string text_of_saving =
        documentation("As Render.save(), of the samples so far.", Call::save);
    nb::class_<PythonRenderer>(
        module, "Renderer",
        "A progressive render: it chooses an integrator once, continues on demand, and has its "
        "image in between. With `spp` samples the image is bit-identical to one render().")
        .def(
            "__init__",
            [](PythonRenderer* self, const PythonScene& scene, const nb::kwargs& options) {
                new (self) PythonRenderer(prepare(scene, options));
            },
            nb::arg("scene"), nb::arg("options"), nb::sig(making.c_str()), text_of_making.c_str())
        .def("render", &PythonRenderer::render, nb::arg("samples"),
             nb::arg("progress").none() = nb::none(),
             "Adds that many samples to each pixel. progress is as in render(); samples rendered "
             "before its exception, or before Ctrl-C, are kept.")
        .def("finish", &PythonRenderer::finish, nb::arg("progress").none() = nb::none(),
             "Renders the samples missing from spp, up to the limits of time and noise.")
        .def(
            "__iadd__",
            [](PythonRenderer& self, const Render& other) -> PythonRenderer& {
                self.add(other);
                return self;
            },
            nb::arg("other"), nb::rv_policy::reference,
            "Adds samples of the same render that were rendered elsewhere.")
        .def_prop_ro(
            "image", [](const PythonRenderer& self) { return to_array(self.renderer().image()); },
            nb::rv_policy::reference, "As Render.image, of the samples so far.")
        .def_prop_ro(
            "noise", [](const PythonRenderer& self) { return self.renderer().noise(); },
            "As Render.noise; infinite with fewer than two samples.")
        .def_prop_ro(
            "spp", [](const PythonRenderer& self) { return self.renderer().samples(); },
            "Its number of samples per pixel.")
        .def_prop_ro(
            "seconds", [](const PythonRenderer& self) { return self.renderer().seconds(); },
            "Render time so far.")
        .def("take", &PythonRenderer::take,
             "All samples as a Render; the Renderer is then empty, and += restores them.")
        .def(
            "save",
            [](PythonRenderer& self, const nb::object& file, const nb::kwargs& options) {
                self.look_at_result([&](const Render& render) { save(render, file, options); });
            },
            nb::arg("file"), nb::arg("options"), nb::sig(saving.c_str()), text_of_saving.c_str())
        .def(
            "_repr_png_",
            [](PythonRenderer& self) {
                return self.look_at_result([](const Render& render) { return to_png(render); });
            },
            "For notebooks.")
        .def("__repr__", [](const PythonRenderer& self) {
            return nb::str("<bdpt.Renderer, {} samples per pixel>")
                .format(self.renderer().samples());
        });
}

}  // namespace bdpt::python
