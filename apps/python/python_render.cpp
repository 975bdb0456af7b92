#include <bdpt/error.h>
#include <bdpt/noise.h>
#include <bdpt/options/option_text.h>
#include <fmt/format.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <new>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "interpreter_lock.h"
#include "machine/machine_limits.h"
#include "messages/console.h"
#include "options/groups/sequence_arguments.h"
#include "options/output_files.h"
#include "options/render_arguments.h"
#include "output/image_files.h"
#include "output/parts.h"
#include "output/render_report.h"
#include "python_errors.h"
#include "python_parts.h"
#include "python_render.h"
#include "stage/prepared_scene.h"

namespace bdpt::python {
namespace {

namespace fs = std::filesystem;

/// Checks for Ctrl-C and reports the progress, between passes.
void tell(const Progress& progress, const nb::object& listener)
{
    const Locked lock;
    if (PyErr_CheckSignals() != 0) {
        throw nb::python_error();
    }
    if (!listener.is_none()) {
        sleep_when_python_ends(
            [&] { listener(progress.samples_done, progress.samples_total, progress.seconds); });
    }
}

/// Returns the view of render() before any turn: that of load(), or that of its own options.
job::Viewpoint first_viewpoint(const PythonScene& scene, job::RenderArguments arguments,
                               bool is_other_view)
{
    const job::Size own = scene.stage.size;
    const job::Size size = arguments.size.value_or(own);
    const bool is_of_arrays = scene.file.empty();
    const bool resized = size.width != own.width || size.height != own.height;
    if (!is_other_view && !arguments.sequence && (!resized || is_of_arrays)) {
        return {.camera = scene.stage.camera, .size = size, .is_framed = scene.stage.is_framed};
    }
    if (is_of_arrays) {
        arguments.size = size;
        arguments.file = "scene of arrays";
    }
    return viewpoint(scene.stage, arguments);
}

/// Returns the view of a turntable that render() renders. Throws `Error` if there are several.
job::SequenceView only_view(const job::RenderArguments& arguments)
{
    const std::vector<job::SequenceView> views = make_views(arguments, {});
    if (views.size() != 1) {
        throw Error(ErrorCode::usage,
                    fmt::format("orbit: render() renders one of the {} views, chosen by frames, "
                                "like frames=1; bdpt.orbit() renders all",
                                views.size()));
    }
    return views.front();
}

nb::kwargs without(const nb::kwargs& options, const char* name)
{
    const nb::object others = options.attr("copy")();
    others.attr("pop")(name);
    return nb::borrow<nb::kwargs>(others);
}

/// As `prepare`, but not yet with `MissingFile`.
Task prepare_task(const PythonScene& scene, const nb::kwargs& options)
{
    std::optional<PythonCamera> given;
    if (options.contains("camera") && nb::isinstance<PythonCamera>(options["camera"])) {
        given = nb::cast<PythonCamera>(options["camera"]);
    }
    const Words own = to_words(given ? without(options, "camera") : options, Call::render);
    if (given && change_view(own)) {
        throw ValueError(
            "camera: a Camera has its own view and lens: no other option can change "
            "them");
    }
    Task task{.arguments =
                  understand_render(combined(given ? without_view(scene.words) : scene.words, own)),
              .stage = scene.stage};
    job::RenderArguments& arguments = task.arguments;
    job::PreparedScene& stage = task.stage;
    arguments.file = scene.file;
    job::Viewpoint first;
    if (given) {
        if (given->size && !options.contains("size")) {
            arguments.size = given->size;
        }
        first = {.camera = given->in_world(stage.scene.description().origin),
                 .size = arguments.size.value_or(stage.size)};
    } else {
        first = first_viewpoint(scene, arguments, change_view(own));
    }
    const Unlocked unlocked;
    std::optional<double> turn;  // of the environment, too
    job::Viewpoint seen = first;
    if (arguments.sequence) {
        const job::SequenceView view = only_view(arguments);
        arguments = make_view_arguments(arguments, view);
        seen = sequence_viewpoint(stage, first, arguments);
        if (arguments.sequence->motion == job::TurntableMotion::object) {
            turn = view.turn;
        }
    }
    arguments.options.film.width = seen.size.width;
    arguments.options.film.height = seen.size.height;
    io::MemoryBudget memory = stage.memory;
    spend_film(memory, arguments.options, seen.size);
    arguments.options.sampling.samples = arguments.samples;
    if (job::meters_light(arguments, stage)) {
        job::RenderArguments metered = arguments;
        if (given) {
            metered.camera = std::to_string(stage.cameras.size());
            stage.cameras.push_back(first.camera);
        }
        arguments.light_exposure =
            job::metered_exposure(stage, std::move(metered));  // shared by all views of a turn
    }
    stage.camera = std::move(seen.camera);
    stage.size = seen.size;
    if (turn) {
        stage.scene = job::with_turned_environment(stage.scene, *turn);
    }
    // Renders of a given time have no rates, as in the command.
    arguments.may_adapt = arguments.may_adapt && !std::isfinite(arguments.goal.seconds);
    const bool chooses = arguments.options.integrator == IntegratorKind::automatic;
    job::Console silent;
    arguments = with_choice(std::move(arguments), stage, silent);
    nlohmann::ordered_json settings = make_settings(arguments, stage);
    if (chooses) {
        settings["chosen_by"] = "auto";
    }
    task.metadata = make_metadata(arguments, stage, settings);
    job::check_backplate(arguments.display);
    return task;
}

}  // namespace

Task prepare(const PythonScene& scene, const nb::kwargs& options)
{
    return with_missing_file(given_paths(options, Call::render),
                             [&] { return prepare_task(scene, options); });
}

Render empty_render(const Task& task)
{
    return {.part = {},
            .notes = {.goal = SampleSet(task.arguments.samples), .metadata = task.metadata},
            .backdrop = task.arguments.display.backdrop,
            .inputs = job::input_files(task.arguments, task.stage)};
}

RenderControl make_control(const nb::object& progress, const job::Goal& goal)
{
    RenderControl control;
    control.time_limit = goal.seconds;
    control.noise_goal = goal.noise.value_or(0.0);
    control.stop = Workers::all().stop();
    control.on_progress = [&progress](const Progress& done) { tell(done, progress); };
    return control;
}

namespace {

/// Warns in Python of a black image. Throws if the user has made an error of warnings.
void warn_if_black(const Render& render, const PythonScene& scene)
{
    if (!job::is_black(render.part.image(), job::develop_layers(render.part))) {
        return;
    }
    const std::string text =
        in_keywords(job::black_image_text(scene.file.empty() ? "scene of arrays" : scene.file));
    if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) {
        throw nb::python_error();
    }
}

Render render_scene(const PythonScene& scene, const nb::object& progress, const nb::kwargs& options)
{
    const Task task = prepare(scene, options);
    const job::RenderArguments& arguments = task.arguments;
    Render result = empty_render(task);
    const RenderControl control = make_control(progress, arguments.goal);
    {
        const Unlocked unlocked;
        result.part = bdpt::render(task.stage.scene, task.stage.camera, arguments.options, control);
    }
    warn_if_black(result, scene);
    return result;
}

/// Returns the ids of each kind, by name.
std::map<std::string, std::map<std::string, std::uint32_t>> collect_ids(const Render& render)
{
    std::map<std::string, std::map<std::string, std::uint32_t>> result;
    for (const IdManifest& manifest : render.part.ids.manifests()) {
        for (const NamedId& name : manifest.names) {
            result[manifest.layer][name.name] = static_cast<std::uint32_t>(name.id);
        }
    }
    return result;
}

/// Integers of the things that pixels show, and their names, by the kinds that aov=... names.
struct Masks {
    using Array = nb::ndarray<nb::numpy, std::uint32_t>;
    std::map<std::string, Array> arrays;
    std::map<std::string, std::vector<std::string>> names;  // 0: nothing
};

Masks collect_masks(const Render& render)
{
    Masks result;
    for (const IdKind kind : id_kinds) {
        const auto which = static_cast<std::size_t>(kind);
        if (!render.part.aovs.aovs().contains(id_aovs[which])) {
            continue;
        }
        const std::string name = option_text(id_aovs[which]);
        const PixelRect& region = render.part.film.region();
        result.arrays.emplace(name,
                              to_array<std::uint32_t>(render.part.ids.mask(kind, render.part.film),
                                                      {static_cast<std::size_t>(region.height()),
                                                       static_cast<std::size_t>(region.width())}));
        std::vector<std::string>& names = result.names[name];
        names.emplace_back();
        for (const NamedId& named : render.part.ids.names()[which]) {
            names.push_back(named.name);
        }
    }
    return result;
}

Masks::Array find_mask(const Masks& masks, const std::string& kind)
{
    const auto found = masks.arrays.find(kind);
    if (found == masks.arrays.end()) {
        throw nb::key_error(fmt::format("{}: the render has no aov=\"{}\"", kind, kind).c_str());
    }
    return found->second;
}

std::vector<std::string> mask_kinds(const Masks& masks)
{
    std::vector<std::string> kinds;
    for (const auto& [kind, array] : masks.arrays) {
        kinds.push_back(kind);
    }
    return kinds;
}

std::map<std::string, FloatArray> collect_layers(const Render& render)
{
    std::map<std::string, FloatArray> arrays;
    for (Layer& layer : job::develop_layers(render.part)) {
        const std::string name = layer.name.empty() ? "alpha" : layer.name;
        arrays.emplace(name, to_array(std::move(layer)));
    }
    return arrays;
}

io::ImageMetadata current_metadata(const Render& render)
{
    return job::completed(render.notes.metadata, render.part.samples.count(), render.part.seconds);
}

/// Calls `write` with the options for writing images of `render` to `files`.
template <typename Write>
void with_file_options(const Render& render, SaveArguments asked, std::span<const fs::path> files,
                       const Write& write)
{
    if (!asked.display.backdrop) {
        asked.display.backdrop = render.backdrop;
    } else if (!render.backdrop) {
        throw Error(ErrorCode::usage, "background: pass it to render(), too");
    }
    job::check_transparency(asked.display, files);
    job::check_metered(asked.display.exposure, render.notes.metadata, "the render");
    const auto denoiser = job::open_denoiser(asked.denoise, files, 0);
    write(job::image_file_options(render.part, current_metadata(render), asked.exr, asked.display,
                                  denoiser ? &*denoiser : nullptr, asked.denoise));
}

/// Returns the pixels of the PNG file of save(), as an array.
nb::object to_srgb(const Render& render, const nb::kwargs& options)
{
    const std::vector<fs::path> file{"image.png"};  // never written
    nb::object array;
    with_file_options(render, understand_save(to_words(options, Call::save)), file,
                      [&](job::ImageFileOptions how) {
                          array = to_array(job::screen_image(render.part.image(), std::move(how)));
                      });
    return array;
}

Render read_part(const fs::path& file)
{
    const io::PartInfo info = with_missing_file({file}, [&] { return io::read_part_info(file); });
    Render render{.part = {}, .notes = info.notes};
    io::MemoryBudget memory(job::memory_limit(std::nullopt));
    io::merge_part(render.part, info, &memory);
    render.backdrop = job::display_of_parts(info, {}).backdrop;
    render.part.seconds = info.notes.metadata.render_seconds;
    return render;
}

void save_file(const Render& render, const fs::path& file, const SaveArguments& asked)
{
    const std::vector<fs::path> files{file};
    job::check_outputs(files, render.inputs);
    if (job::is_part_name(file)) {
        io::PartNotes notes = render.notes;
        notes.metadata = current_metadata(render);
        io::write_part(file, render.part, notes, io::OldPart::replace);
        return;
    }
    with_file_options(render, asked, files, [&](job::ImageFileOptions how) {
        job::Attempts attempts;
        job::write_image_files(files, render.part.image(), std::move(how), attempts);
        attempts.finish();
    });
}

/// Returns the bytes of the file that save_file() writes in this format.
nb::bytes to_bytes(const Render& render, const std::string& format, const SaveArguments& asked)
{
    const job::TemporaryFolder folder;
    const fs::path file = folder.file("image." + format);
    save_file(render, file, asked);
    return read_bytes(file);
}

/// Returns the format that the options of save() name.
std::optional<std::string> given_format(const nb::kwargs& options)
{
    static constexpr std::array known{"exr", "hdr", "png", "jpg", "webp", "part"};
    if (!options.contains("format") || options["format"].is_none()) {
        return std::nullopt;
    }
    const auto format = nb::cast<std::string>(nb::str(options["format"]));
    if (!job::is_among(known, format)) {
        throw ValueError(fmt::format("format={}: expected exr, hdr, png, jpg, webp or part",
                                     written(options["format"])));
    }
    return format;
}

}  // namespace

void save(const Render& render, const nb::object& file, const nb::kwargs& options)
{
    const std::optional<std::string> format = given_format(options);
    const SaveArguments asked = understand_save(
        to_words(options.contains("format") ? without(options, "format") : options, Call::save));
    if (!is_writable_object(file)) {
        if (format) {
            throw Error(ErrorCode::usage,
                        "format is for file objects only; the name of a file determines its "
                        "format");
        }
        save_file(render, to_path(file), asked);
        return;
    }
    if (!format) {
        throw Error(ErrorCode::usage,
                    "a file object has no name that determines the format: give format=\"png\" or "
                    "another one");
    }
    file.attr("write")(to_bytes(render, *format == "part" ? "part.exr" : *format, asked));
}

nb::bytes to_png(const Render& render)
{
    return to_bytes(render, "png", {});
}

void bind_render(nb::module_& module)
{
    const std::string saving = declaration(saving_head, Call::save, "None");
    const std::string text_of_saving = documentation(
        "Writes a file, or in the given format to an object with write(): an image, .exr (linear "
        "radiance and layers), .hdr (linear radiance), .png, .jpg or .webp (tone-mapped), or a "
        "part, .part.exr, for bdpt merge and bdpt render --part.",
        Call::save);
    const std::string showing =
        declaration("def to_srgb(self, *", Call::save, "numpy.typing.NDArray[numpy.uint8]");
    const std::string text_of_showing = documentation(
        "What save() writes to a PNG file, as an array of uint8, or uint16 with png_bits=16, "
        "(height, width, 3), or 4 with a transparent background.",
        Call::save);
    nb::class_<Masks>(module, "Masks",
                      "Masks of a render, by kind: 'object', 'instance' or 'material', as aov=... "
                      "names them.")
        .def("__getitem__", &find_mask, nb::arg("kind"), nb::rv_policy::reference,
             "An array of uint32 (height, width): the integer of what most rays of the pixel hit, "
             "or 0 for nothing; ties go to the smaller integer.")
        .def("__len__", [](const Masks& masks) { return masks.arrays.size(); })
        .def(
            "__iter__", [](const Masks& masks) { return nb::iter(nb::cast(mask_kinds(masks))); },
            nb::sig("def __iter__(self) -> collections.abc.Iterator[str]"))
        .def("keys", &mask_kinds, "The kinds.")
        .def("__repr__",
             [](const Masks& masks) {
                 return fmt::format("<bdpt.Masks {}>", fmt::join(mask_kinds(masks), ", "));
             })
        .def_ro("names", &Masks::names,
                "The names, by kind: element i is the name of integer i, and element 0 is ''.");
    nb::class_<Render>(module, "Render",
                       "Result of a render: sums of samples, which add up exactly.")
        .def_prop_ro(
            "image", [](const Render& render) { return to_array(render.part.image()); },
            nb::rv_policy::reference,
            "Linear radiance [nit], Rec. 709: an array of float32 (height, width, 3), row 0 at the "
            "top.")
        .def_prop_ro("layers", &collect_layers, nb::rv_policy::reference,
                     "Layers of aov=..., by name: arrays of float32 (height, width, channels).")
        .def_prop_ro(
            "ids", &collect_ids,
            "Ids by name in the layers of aov='object', 'instance' and 'material', such as "
            "ids['CryptoObject']['lamp']: integers with the bits of the floats in "
            "layers['CryptoObject00'].")
        .def_prop_ro("masks", &collect_masks,
                     "Masks of integers with aov='object', 'instance' or 'material': "
                     "masks['instance'] is an array (height, width), and masks.names['instance'] "
                     "the list of their names.")
        .def_prop_ro(
            "samples", [](const Render& render) { return render.part.samples.text(); },
            "Indices of its samples of each pixel, like '0:64'.")
        .def_prop_ro(
            "spp", [](const Render& render) { return render.part.samples.count(); },
            "Its number of samples per pixel.")
        .def_prop_ro(
            "noise",
            [](const Render& render) { return estimate_noise(render.part.film, render.part.aovs); },
            "Relative standard error that 95 % of all tiles of 16 x 16 pixels do not exceed.")
        .def_prop_ro(
            "settings", [](const Render& render) { return render.notes.metadata.settings; },
            "All options of the render, as JSON.")
        .def(
            "__iadd__",
            [](Render& render, const Render& other) -> Render& {
                const Unlocked unlocked;
                merge(render.part, other.part);
                return render;
            },
            nb::arg("other"), nb::rv_policy::reference,
            "Adds other samples of the same render; the result is bit-identical to one render of "
            "all.")
        .def("save", &save, nb::arg("file"), nb::arg("options"), nb::sig(saving.c_str()),
             text_of_saving.c_str())
        .def("to_srgb", &to_srgb, nb::arg("options"), nb::sig(showing.c_str()),
             text_of_showing.c_str())
        .def("_repr_png_", &to_png, "For notebooks.")
        .def("__getstate__", [](const Render& render) { return to_bytes(render, "part.exr", {}); })
        .def("__setstate__",
             [](Render& render, const nb::bytes& part) {
                 const job::TemporaryFolder folder;
                 write_bytes(folder.file("image.part.exr"), part);
                 new (&render) Render(read_part(folder.file("image.part.exr")));
             })
        .def(
            "__array__",
            [](const Render& render, const nb::object& dtype, const nb::object& copy) {
                static_cast<void>(copy);  // it is always a copy
                const nb::object image = nb::cast(to_array(render.part.image()));
                return dtype.is_none() ? image : image.attr("astype")(dtype);
            },
            nb::arg("dtype").none() = nb::none(), nb::arg("copy").none() = nb::none(),
            "numpy.asarray(render) is render.image.")
        .def("__repr__", [](const Render& render) {
            const FilmLayout& layout = render.part.film.layout();
            return nb::str("<bdpt.Render {}x{}, samples {}>")
                .format(layout.width, layout.height, render.part.samples.text());
        });
    const std::string rendering = declaration(
        "def render(scene: Scene, *, progress: collections.abc.Callable[[int, int, float], object] "
        "| None = None",
        Call::render, "Render");
    const std::string text_of_rendering = documentation(
        "Renders the scene. Options are those of bdpt render, with the same defaults: the image is "
        "bit-identical to the command's. progress(done, total, seconds) is called between passes; "
        "an exception from it, or Ctrl-C, ends the render. Other Python threads run meanwhile.",
        Call::render);
    module.def("render", &render_scene, nb::arg("scene"), nb::kw_only(),
               nb::arg("progress").none() = nb::none(), nb::arg("options"),
               nb::sig(rendering.c_str()), text_of_rendering.c_str());
    bind_renderer(module);
    module.def("read_part", &read_part, nb::arg("file"),
               "Reads a part written by save('x.part.exr') or bdpt render --part.");
}

}  // namespace bdpt::python
