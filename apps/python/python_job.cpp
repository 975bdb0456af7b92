#include <bdpt/job.h>
#include <fmt/core.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "interpreter_lock.h"
#include "options/option_list.h"
#include "python_errors.h"
#include "python_scene.h"
#include "words.h"

namespace bdpt::python {
namespace {

namespace nb = nanobind;

/// Observes a job for Python. Ctrl-C stops it, so that the samples so far are written; what a
/// callback raises ends it at once.
class Observer {
public:
    Observer(const nb::object& progress, const nb::object& message)
        : progress_(progress), message_(message)
    {}

    [[nodiscard]] JobControl control()
    {
        JobControl control;
        control.stop = stop_.get_token();
        control.on_progress = [this](const JobProgress& now) { tell(now); };
        if (!message_.is_none()) {
            control.on_message = [this](MessageKind kind, std::string_view text) {
                const Locked lock;
                call([&] {
                    message_(kind == MessageKind::note ? "note" : "warning", std::string(text));
                });
            };
        }
        return control;
    }
    /// Raises KeyboardInterrupt if Ctrl-C has stopped the job.
    void raise_interrupt()
    {
        if (interrupt_) {
            nb::python_error interrupt = std::move(*interrupt_);
            throw interrupt;
        }
    }

private:
    void tell(const JobProgress& now)
    {
        const Locked lock;
        call([&] {
            if (PyErr_CheckSignals() != 0) {
                throw nb::python_error();
            }
            if (!progress_.is_none()) {
                progress_(now);
            }
        });
    }

    /// Calls `work()`, which may run Python. Ctrl-C may also arrive within a callback.
    template <typename Work>
    void call(const Work& work)
    {
        if (interrupt_) {
            return;
        }
        try {
            sleep_when_python_ends(work);
        } catch (nb::python_error& error) {
            if (!error.matches(PyExc_KeyboardInterrupt)) {
                throw;
            }
            interrupt_.emplace(std::move(error));
            stop_.request_stop();
        }
    }

    const nb::object& progress_;
    const nb::object& message_;
    std::optional<nb::python_error> interrupt_;
    std::stop_source stop_;
    std::stop_callback<std::function<void()>> when_python_ends_{Workers::all().stop(),
                                                                [this] { stop_.request_stop(); }};
};

std::vector<JobImage> run_job(const nb::object& file, const nb::object& progress,
                              const nb::object& message, const nb::kwargs& options)
{
    const std::filesystem::path path = to_path(file);
    Observer observer(progress, message);
    std::vector<std::filesystem::path> files = given_paths(options, Call::run);
    files.insert(files.begin(), path);
    return with_missing_file(files, [&] {
        RenderJob job = job::is_job(path) ? RenderJob::from_file(path) : RenderJob(path);
        set_options(job, options);
        JobResult result;
        {
            const Unlocked unlocked;
            result = run(job, observer.control());
        }
        observer.raise_interrupt();
        return result.images;
    });
}

}  // namespace

void bind_job(nb::module_& module)
{
    nb::class_<JobProgress>(module, "JobProgress", "Progress of run(), between passes.")
        .def_ro("image", &JobProgress::image, "Index of the image.")
        .def_ro("images", &JobProgress::images, "Number of images of the job.")
        .def_ro("fraction", &JobProgress::fraction, "Of the image, from 0 to 1.")
        .def_ro("seconds_left", &JobProgress::seconds_left, "For the image, estimated.")
        .def_prop_ro(
            "spp", [](const JobProgress& now) { return now.render.samples_done; },
            "Samples of each pixel that are done.")
        .def_prop_ro(
            "seconds", [](const JobProgress& now) { return now.render.seconds; },
            "How long the image has been rendered.")
        .def_prop_ro(
            "noise", [](const JobProgress& now) { return now.render.noise; },
            "As Render.noise, when it was last measured.")
        .def("__repr__", [](const JobProgress& now) {
            return fmt::format("<bdpt.JobProgress image {} of {}, {:.0f} %, {} spp>", now.image,
                               now.images, 100.0 * now.fraction, now.render.samples_done);
        });
    nb::class_<JobImage>(module, "JobImage", "An image that run() rendered and wrote.")
        .def_ro("files", &JobImage::files, "All files that were written.")
        .def_ro("frame", &JobImage::frame, "Number of the frame or view, in a sequence.")
        .def_ro("camera", &JobImage::camera, "Name of the camera, if the job renders several.")
        .def_ro("spp", &JobImage::samples_per_pixel, "How many samples of each pixel it has.")
        .def_ro("seconds", &JobImage::seconds, "How long it was rendered.")
        .def_ro("noise", &JobImage::noise, "As Render.noise.")
        .def_ro("exposure", &JobImage::exposure, "Exposure of files for screens [EV].")
        .def_ro("stopped", &JobImage::stopped, "Whether it was stopped before it was done.")
        .def("__repr__", [](const JobImage& image) {
            std::string files;
            for (const std::filesystem::path& file : image.files) {
                files += (files.empty() ? "" : ", ") + file.string();
            }
            return fmt::format("<bdpt.JobImage {}, {} spp>", files, image.samples_per_pixel);
        });
    const std::string running = declaration(
        "def run(file: str | os.PathLike[str], *, progress: "
        "collections.abc.Callable[[JobProgress], object] | None = None, message: "
        "collections.abc.Callable[[str, str], object] | None = None",
        Call::run, "list[JobImage]");
    const std::string text = documentation(
        "Does what bdpt render does: loads a scene, or reads a job (.json), renders it and writes "
        "all files. Options are those of bdpt render; they override the job's, and False removes "
        "a flag. progress is called between passes, message(kind, text) with the messages of the "
        "command: kind is 'note' or 'warning'. What they raise ends the job. Ctrl-C stops it, and "
        "what is there is written. Other Python threads run meanwhile.",
        Call::run);
    module.def("run", &run_job, nb::arg("file"), nb::kw_only(),
               nb::arg("progress").none() = nb::none(), nb::arg("message").none() = nb::none(),
               nb::arg("options"), nb::sig(running.c_str()), text.c_str());
}

}  // namespace bdpt::python
