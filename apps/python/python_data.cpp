#include <bdpt/tools/ray_query.h>
#include <fmt/core.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <limits>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "interpreter_lock.h"
#include "machine/machine_limits.h"
#include "python_parts.h"
#include "python_scene.h"

namespace bdpt::python {
namespace {

namespace nb = nanobind;

/// An instance of a mesh, in coordinates of the file.
struct PythonInstance {
    std::string name;
    std::size_t mesh = 0;
    std::size_t material = 0;
    DMat4 matrix{1.0};
};

std::vector<PythonInstance> list_instances(const PythonScene& scene)
{
    const SharedSceneDesc& desc = scene.stage.scene.description();
    std::vector<PythonInstance> result;
    for (const InstanceDesc& instance : desc.instances) {
        result.push_back({.name = instance.name,
                          .mesh = static_cast<std::size_t>(instance.mesh),
                          .material = static_cast<std::size_t>(instance.material),
                          .matrix = in_file(instance.world_from_object, desc.origin)});
    }
    return result;
}

/// Returns the geometry of all meshes, which stays in the scene's memory and keeps it.
std::vector<ArrayMesh> list_meshes(const PythonScene& scene)
{
    const auto kept =
        std::make_shared<const SharedList<MeshDesc>>(scene.stage.scene.description().meshes);
    std::vector<ArrayMesh> result;
    for (const MeshDesc& mesh : *kept) {
        result.push_back({.desc = {kept, &mesh},
                          .material = std::make_shared<ArrayMaterial>(),
                          .transforms = {Mat4(1.0f)}});
    }
    return result;
}

/// Binds an array of a mesh: a read-only view of its memory.
template <typename Number, typename Get>
void def_view(nb::class_<ArrayMesh>& type, const char* name, const char* number, const Get& get,
              const char* text)
{
    const std::string signature =
        fmt::format("def {}(self) -> numpy.typing.NDArray[numpy.{}]", name, number);
    type.def_prop_ro(
        name,
        [get](nb::pointer_and_handle<ArrayMesh> self) {
            const auto& values = get(*self.p->desc);
            constexpr auto columns =
                static_cast<std::size_t>(std::remove_cvref_t<decltype(values[0])>::length());
            const std::array shape{values.size(), columns};
            return nb::cast(nb::ndarray<nb::numpy, const Number>(values.data(), shape.size(),
                                                                 shape.data(), nb::borrow(self.h)));
        },
        nb::sig(signature.c_str()), text);
}

nb::object bounds(const PythonScene& scene)
{
    const Bounds box = scene.stage.scene.bounds();
    const DVec3 origin = scene.stage.scene.description().origin;
    const DVec3 low = job::to_file(box.min, origin);
    const DVec3 high = job::to_file(box.max, origin);
    return to_numpy<double>({low.x, low.y, low.z, high.x, high.y, high.z}, {2, 3});
}

/// Returns the indices of the instances that a key of moved() means: a name, or an index. Throws
/// `job::UnknownName`.
std::vector<std::size_t> find_instances(const std::vector<InstanceDesc>& instances, nb::handle key)
{
    std::vector<std::size_t> found;
    std::vector<std::string> names;
    std::string name;
    if (!nb::try_cast(key, name)) {
        std::size_t index = 0;
        if (!nb::try_cast(key, index)) {
            throw CallError(
                fmt::format("{}: expected the name or the index of an instance", written(key)));
        }
        if (index >= instances.size()) {
            throw job::UnknownName(
                fmt::format("no instance {}: the scene has {}", index, instances.size()));
        }
        return {index};
    }
    for (std::size_t i = 0; i < instances.size(); ++i) {
        if (instances[i].name == name) {
            found.push_back(i);
        }
        names.push_back(instances[i].name);
    }
    if (found.empty()) {
        fail_name("instance", name, names);
    }
    return found;
}

PythonScene moved(const PythonScene& scene, const nb::dict& transforms)
{
    const Scene& old = scene.stage.scene;
    SharedSceneDesc desc = old.description();
    std::vector<InstanceDesc> instances = desc.instances;
    for (const auto& [key, value] : transforms) {
        const std::vector<std::size_t> found = find_instances(instances, key);
        const std::string name = written(key);
        const std::vector<DMat4> matrices = to_matrices(value, name);
        if (matrices.size() != 1 && matrices.size() != found.size()) {
            throw ValueError(fmt::format("{}: {} matrices for {} instances", name, matrices.size(),
                                         found.size()));
        }
        for (std::size_t i = 0; i < found.size(); ++i) {
            DMat4 matrix = matrices[matrices.size() == 1 ? 0 : i];
            matrix[3] -= glm::dvec4(desc.origin, 0.0);
            instances[found[i]].world_from_object = Mat4(matrix);
            instances[found[i]].motion.clear();
        }
    }
    desc.instances = std::move(instances);
    const Unlocked unlocked;
    return with_scene(scene, old.edited(std::move(desc)), scene.stage.environment_name);
}

/// Arrays of raycast().
struct RayHits {
    nb::object distance, position, normal, geometric_normal, instance, triangle, barycentrics, uv;
};

/// Calls `work(begin, end)` for parts of [0, count), on several threads if there is enough to do.
/// Throws what it throws.
template <typename Work>
void in_parts(std::size_t count, const Work& work)
{
    constexpr std::size_t worth_a_thread = 4096;
    const auto processors = static_cast<std::size_t>(
        std::min(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())),
                 job::cgroup_limits().processors.value_or(std::numeric_limits<int>::max())));
    const std::size_t parts = std::clamp<std::size_t>(count / worth_a_thread, 1, processors);
    std::vector<std::exception_ptr> failures(parts);
    const auto run_part = [&](std::size_t part) {
        try {
            work(count * part / parts, count * (part + 1) / parts);
        } catch (...) {
            failures[part] = std::current_exception();
        }
    };
    {
        std::vector<std::jthread> threads;
        for (std::size_t part = 1; part < parts; ++part) {
            threads.emplace_back(run_part, part);
        }
        run_part(0);
    }
    for (const std::exception_ptr& failure : failures) {
        if (failure) {
            std::rethrow_exception(failure);
        }
    }
}

RayHits raycast(const PythonScene& scene, const nb::object& origins, const nb::object& directions)
{
    const DoubleInput from = to_doubles(origins, "origins");
    const DoubleInput towards = to_doubles(directions, "directions");
    const auto check_shape = [](const DoubleInput& array, const char* name) {
        if (array.ndim() == 0 || array.shape(array.ndim() - 1) != 3) {
            throw ValueError(fmt::format("{}: expected the shape (..., 3)", name));
        }
    };
    check_shape(from, "origins");
    check_shape(towards, "directions");
    bool is_equal = from.ndim() == towards.ndim();
    std::vector<std::size_t> shape;
    for (std::size_t i = 0; is_equal && i < from.ndim(); ++i) {
        is_equal = from.shape(i) == towards.shape(i);
        shape.push_back(from.shape(i));
    }
    if (!is_equal) {
        throw ValueError("origins and directions have different shapes");
    }
    shape.pop_back();
    const std::size_t count = from.size() / 3;
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    std::vector<float> distance(count, std::numeric_limits<float>::infinity());
    std::vector<double> position(3 * count, none);
    std::vector<float> normal(3 * count, none);
    std::vector<float> geometric_normal(3 * count, none);
    std::vector<std::int64_t> instance(count, -1);
    std::vector<std::int64_t> triangle(count, -1);
    std::vector<float> barycentrics(3 * count, none);
    std::vector<float> uv(2 * count, none);
    const auto store = [](auto& values, std::size_t ray, const auto& value) {
        constexpr auto length = std::remove_cvref_t<decltype(value)>::length();
        for (int i = 0; i < length; ++i) {
            values[ray * static_cast<std::size_t>(length) + static_cast<std::size_t>(i)] = value[i];
        }
    };
    const Scene& world = scene.stage.scene;
    const DVec3 origin = world.description().origin;
    const auto get = [](const DoubleInput& array, std::size_t ray) {
        const double* const row = array.data() + 3 * ray;
        return DVec3(row[0], row[1], row[2]);
    };
    const auto trace = [&](std::size_t begin, std::size_t end) {
        for (std::size_t ray = begin; ray < end; ++ray) {
            std::optional<SurfaceHit> hit;
            try {
                hit = first_hit(world, job::to_world(get(from, ray), origin),
                                Vec3(get(towards, ray)));
            } catch (const Error& error) {
                throw Error(error.code(), fmt::format("ray {}: {}", ray, error.what()));
            }
            if (!hit) {
                continue;
            }
            distance[ray] = hit->distance;
            store(position, ray, job::to_file(hit->position, origin));
            store(normal, ray, hit->shading_normal);
            store(geometric_normal, ray, hit->geometric_normal);
            if (hit->instance) {
                instance[ray] = *hit->instance;
                triangle[ray] = hit->triangle;
            }
            const Vec2 weights = hit->barycentrics;
            store(barycentrics, ray, Vec3(1.0f - weights.x - weights.y, weights.x, weights.y));
            store(uv, ray, hit->uv);
        }
    };
    {
        const Unlocked unlocked;
        in_parts(count, trace);
    }
    const auto with = [&shape](std::size_t columns) {
        std::vector<std::size_t> all = shape;
        all.push_back(columns);
        return all;
    };
    return {.distance = to_numpy(std::move(distance), shape),
            .position = to_numpy(std::move(position), with(3)),
            .normal = to_numpy(std::move(normal), with(3)),
            .geometric_normal = to_numpy(std::move(geometric_normal), with(3)),
            .instance = to_numpy(std::move(instance), shape),
            .triangle = to_numpy(std::move(triangle), shape),
            .barycentrics = to_numpy(std::move(barycentrics), with(3)),
            .uv = to_numpy(std::move(uv), with(2))};
}

void bind_ray_hits(nb::module_& module)
{
    nb::class_<RayHits> hits(module, "RayHits",
                             "What rays hit first: arrays, one item per ray. Where nothing is hit, "
                             "distance is infinite, indices are -1, and all else is not a number.");
    const auto def_array = [&hits](const char* name, nb::object RayHits::*member,
                                   const char* number, const char* text) {
        const std::string signature =
            fmt::format("def {}(self) -> numpy.typing.NDArray[numpy.{}]", name, number);
        hits.def_prop_ro(
            name, [member](const RayHits& self) { return self.*member; },
            nb::sig(signature.c_str()), text);
    };
    def_array("distance", &RayHits::distance, "float32", "[m]; infinite where nothing is hit.");
    def_array("position", &RayHits::position, "float64", "(..., 3) [m], in the file.");
    def_array("normal", &RayHits::normal, "float32",
              "(..., 3): unit normal of the front side, interpolated and normal-mapped.");
    def_array("geometric_normal", &RayHits::geometric_normal, "float32",
              "(..., 3): unit normal of the front side of the triangle.");
    def_array("instance", &RayHits::instance, "int64",
              "Index into Scene.instances; -1: nothing, or the sphere of a light.");
    def_array("triangle", &RayHits::triangle, "int64", "Index into the triangles of the mesh.");
    def_array("barycentrics", &RayHits::barycentrics, "float32",
              "(..., 3): weights of the vertices of the triangle.");
    def_array("uv", &RayHits::uv, "float32", "(..., 2): TEXCOORD_0; 0 if the mesh has none.");
    hits.def("__repr__", [](const RayHits& self) {
        return fmt::format("<bdpt.RayHits of {} rays>",
                           nb::cast<std::size_t>(self.distance.attr("size")));
    });
}

}  // namespace

void bind_scene_data(nb::module_& module)
{
    nb::class_<PythonInstance>(module, "Instance", "A mesh that is placed in a scene.")
        .def_ro("name", &PythonInstance::name, "Its name in id layers; '' where it has none.")
        .def_ro("mesh", &PythonInstance::mesh, "Index into Scene.meshes.")
        .def_ro("material", &PythonInstance::material, "Index into Scene.materials.")
        .def_prop_ro(
            "matrix", [](const PythonInstance& self) { return to_numpy(self.matrix); },
            nb::sig("def matrix(self) -> numpy.typing.NDArray[numpy.float64]"),
            "4 x 4 matrix from the mesh to the world [m].")
        .def("__repr__", [](const PythonInstance& self) {
            return fmt::format("<bdpt.Instance {} of mesh {}, material {}>", value_text(self.name),
                               self.mesh, self.material);
        });
    bind_ray_hits(module);
    const nb::object mesh = module.attr("Mesh");
    auto mesh_type = nb::borrow<nb::class_<ArrayMesh>>(mesh);
    mesh_type.def_prop_ro(
        "name", [](const ArrayMesh& self) { return self.desc->name; }, "Its name.");
    def_view<float>(
        mesh_type, "positions", "float32",
        [](const MeshDesc& desc) -> const auto& { return desc.positions; },
        "(n, 3) [m], a read-only view.");
    def_view<float>(
        mesh_type, "normals", "float32",
        [](const MeshDesc& desc) -> const auto& { return desc.normals; },
        "(n, 3), a read-only view; (0, 3) without normals.");
    def_view<float>(
        mesh_type, "uvs", "float32",
        [](const MeshDesc& desc) -> const auto& { return desc.uvs[0]; },
        "(n, 2), a read-only view of TEXCOORD_0, whose v points down; (0, 2) without it.");
    def_view<float>(
        mesh_type, "colors", "float32",
        [](const MeshDesc& desc) -> const auto& { return desc.colors; },
        "(n, 4), a read-only view: linear RGBA; (0, 4) without colours.");
    def_view<std::uint32_t>(
        mesh_type, "triangles", "uint32",
        [](const MeshDesc& desc) -> const auto& { return desc.triangles; },
        "(m, 3): indices of vertices, a read-only view.");
    const nb::object scene = module.attr("Scene");
    nb::cast<nb::class_<PythonScene>>(scene)
        .def_prop_ro(
            "camera",
            [](const PythonScene& self) {
                return PythonCamera{.desc = self.stage.camera,
                                    .origin = self.stage.scene.description().origin,
                                    .size = self.stage.size};
            },
            "Its camera.")
        .def_static(
            "from_trimesh",
            [](const nb::object& source, bool smooth, const nb::object& lights,
               const nb::object& camera, const nb::object& size) {
                return nb::module_::import_("bdpt._trimesh")
                    .attr("to_scene")(source, smooth, lights, camera, size);
            },
            nb::arg("source"), nb::kw_only(), nb::arg("smooth") = false,
            nb::arg("lights") = nb::make_tuple(), nb::arg("camera") = nb::none(),
            nb::arg("size") = nb::none(),
            nb::sig("def from_trimesh(source: typing.Any, *, smooth: bool = False, lights: "
                    "collections.abc.Sequence[PointLight | SpotLight | DirectionalLight | "
                    "EnvironmentLight] = (), camera: Camera | None = None, size: tuple[int, int] | "
                    "None = None) -> Scene"),
            "A scene of a mesh or a scene of trimesh, or of a scene of pyrender: triangles with "
            "their names, places, colours, materials of glTF and textures; its camera, and the "
            "lights of pyrender, unless others are given. Colours are taken for linear, as in "
            "glTF. smooth: normals also where the mesh of trimesh has none of its own.")
        .def_prop_ro("bounds", &bounds,
                     nb::sig("def bounds(self) -> numpy.typing.NDArray[numpy.float64]"),
                     "The box around all instances [m]: [[x, y, z] of its lowest corner, those of "
                     "its highest].")
        .def_prop_ro("meshes", &list_meshes,
                     "The geometry of its meshes, without materials and places. Arrays are views "
                     "of the scene's memory.")
        .def_prop_ro("instances", &list_instances, "Where its meshes are, with which material.")
        .def("moved", &moved, nb::arg("transforms"),
             nb::sig("def moved(self, transforms: collections.abc.Mapping[str, "
                     "numpy.typing.ArrayLike] | collections.abc.Mapping[int, "
                     "numpy.typing.ArrayLike]) -> Scene"),
             "The scene with instances elsewhere. Keys are names of instances, or their indices; "
             "values are 4 x 4 matrices from the mesh to the world [m], as Instance.matrix. All "
             "instances of a name are moved: to the same place, or to those of an array (k, 4, 4). "
             "Meshes and trees are shared with the scene, which stays as it is. Raises ValueError "
             "for an unknown name and for a matrix that cannot be inverted.")
        .def("raycast", &raycast, nb::arg("origins"), nb::arg("directions"),
             nb::sig("def raycast(self, origins: numpy.typing.ArrayLike, directions: "
                     "numpy.typing.ArrayLike) -> RayHits"),
             "What rays hit first: origins [m] and directions (of any length above 0) are arrays "
             "of the same shape (..., 3). Surfaces with alpha are hit unless they are fully "
             "transparent there. Uses all processors; other Python threads run meanwhile. Raises "
             "ValueError for other shapes, values that are not finite and directions of 0.");
}

}  // namespace bdpt::python
