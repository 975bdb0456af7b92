#include <bdpt/render_options.h>
#include <bdpt/tools/pixel_hits.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dataset/dataset.h"
#include "interpreter_lock.h"
#include "python_parts.h"
#include "python_scene.h"
#include "stage/prepared_scene.h"

namespace bdpt::python {
namespace {

namespace nb = nanobind;

/// The views of one model, as `bdpt dataset` has them.
struct ModelViews {
    job::DatasetArguments arguments;
    std::vector<PythonCamera> cameras{};
    std::vector<std::uint64_t> seeds{};
    std::vector<IdNumbers> masks{};   // by `id_kinds`; empty: not asked for
    std::optional<float> exposure{};  // [EV]
};

/// Parses options of `bdpt dataset`, without models and outputs.
job::DatasetArguments understand_dataset(Words words)
{
    job::DatasetRequest request;
    job::OptionList options;
    add_dataset_options(options, request);
    words.insert(words.end(), {"model", "--output=."});
    give_words(words, options);
    return checked(request, options);
}

ModelViews model_views(const PythonScene& scene, const std::string& model, const Words& words)
{
    ModelViews result{.arguments = understand_dataset(words)};
    const Scene& world = scene.stage.scene;
    const Unlocked unlocked;
    for (job::PosedCamera& view : posed_cameras(result.arguments, world, model)) {
        const auto index = static_cast<int>(result.cameras.size());
        result.cameras.push_back({.desc = std::move(view.camera),
                                  .origin = world.description().origin,
                                  .size = view.size});
        result.seeds.push_back(seed_of_frame(result.arguments.render.options.sampling.seed, index));
    }
    result.masks = mask_numbers(result.arguments, world);
    if (!result.cameras.empty()) {
        const PythonCamera& first = result.cameras.front();
        result.exposure = metered_exposure(world, first.desc, first.size.value());
    }
    return result;
}

/// Returns the layers of view `index`: arrays by name, and for masks the names of the integers.
std::pair<nb::dict, nb::dict> layers_of_view(const ModelViews& views, const PythonScene& scene,
                                             std::size_t index)
{
    const PythonCamera& camera = views.cameras.at(index);
    const Scene& world = scene.stage.scene;
    const DVec3 origin = world.description().origin;
    const CameraDesc desc = camera.in_world(origin);
    const auto width = static_cast<std::size_t>(camera.size->width);
    const auto height = static_cast<std::size_t>(camera.size->height);
    PixelHits seen;
    std::vector<job::LayerValues> floats;
    std::vector<std::vector<std::uint32_t>> masks;
    std::vector<float> motion;
    std::vector<std::uint8_t> visible;
    {
        const Unlocked unlocked;
        seen = pixel_hits(world, desc, camera.size->width, camera.size->height);
        floats = float_layers(views.arguments, world, desc, seen);
        for (const IdNumbers& numbers : views.masks) {
            masks.push_back(id_mask(seen, numbers));
        }
        if (views.arguments.has(job::DatasetLayer::flow) && index + 1 < views.cameras.size()) {
            for (const PixelFlow& pixel :
                 optical_flow(seen, world, views.cameras[index + 1].in_world(origin))) {
                motion.insert(motion.end(), {pixel.motion.x, pixel.motion.y});
                visible.push_back(pixel.is_visible ? 1 : 0);
            }
        }
    }
    nb::dict arrays;
    nb::dict names;
    for (job::LayerValues& layer : floats) {
        std::vector<std::size_t> shape{height, width};
        if (layer.channels.size() > 1) {
            shape.push_back(layer.channels.size());
        }
        arrays[nb::str(layer.name.data(), layer.name.size())] =
            to_numpy(std::move(layer.values), shape);
    }
    for (std::size_t kind = 0; kind < masks.size(); ++kind) {
        const std::string name(job::mask_name(id_kinds.at(kind)));
        arrays[name.c_str()] = to_numpy(std::move(masks[kind]), {height, width});
        names[name.c_str()] = nb::cast(views.masks[kind].names);
    }
    if (!visible.empty()) {
        arrays["flow"] = to_numpy(std::move(motion), {height, width, 2});
        arrays["flow_visible"] = to_numpy(std::move(visible), {height, width}).attr("view")("bool");
    }
    return {arrays, names};
}

}  // namespace

void bind_dataset(nb::module_& module)
{
    module.def(
        "check_dataset_words",
        [](const Words& words) { static_cast<void>(understand_dataset(words)); }, nb::arg("words"),
        "Raises what ModelViews raises for wrong words.");
    nb::class_<ModelViews>(module, "ModelViews", "The views of a model, for dataset().")
        .def(nb::new_(&model_views), nb::arg("scene"), nb::arg("model"), nb::arg("words"))
        .def_ro("cameras", &ModelViews::cameras, "Their cameras.")
        .def_ro("seeds", &ModelViews::seeds, "Their random seeds.")
        .def_ro("exposure", &ModelViews::exposure,
                "The exposure of their pictures [EV], by the light of the first view; None: no "
                "light falls on it.")
        .def(
            "layers",
            [](const ModelViews& views, const PythonScene& scene, std::size_t index) {
                const auto [arrays, names] = layers_of_view(views, scene, index);
                return nb::make_tuple(arrays, names);
            },
            nb::arg("scene"), nb::arg("index"),
            nb::sig("def layers(self, scene: Scene, index: int) -> "
                    "tuple[dict[str, numpy.typing.NDArray[typing.Any]], dict[str, list[str]]]"),
            "The layers of a view by name, and for masks the names of integers.");
}

}  // namespace bdpt::python
