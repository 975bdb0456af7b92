#include "dataset/dataset.h"

#include <bdpt/error.h>
#include <bdpt/io/json_value.h>
#include <bdpt/io/read_image.h>
#include <bdpt/io/write_image.h>
#include <bdpt/version.h>
#include <fmt/core.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "options/output_files.h"

namespace bdpt::job {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr double millimetres = 1000.0;
constexpr double most_of_16_bits = 65535.0;

/// A layer of floats: its files, and its values where a surface was hit.
struct FloatLayer {
    DatasetLayer layer;
    std::string_view name;
    std::string_view channels;  ///< of the .exr file, as most readers want them
    float empty;                ///< value without a surface
};

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr std::array kinds_of_floats{
    FloatLayer{DatasetLayer::depth, "depth", "Z", infinite},
    FloatLayer{DatasetLayer::distance, "distance", "Z", infinite},
    FloatLayer{DatasetLayer::normal, "normal", "RGB", 0.0f},
    FloatLayer{DatasetLayer::camera_normal, "camera-normal", "RGB", 0.0f},
    FloatLayer{DatasetLayer::uv, "uv", "RG", 0.0f},
    FloatLayer{DatasetLayer::position, "position", "RGB", 0.0f}};

std::string file_name(std::string_view number, std::string_view layer, std::string_view type)
{
    return fmt::format("{}.{}.{}", number, layer, type);
}

io::ImageMetadata metadata_of_layers()
{
    io::ImageMetadata metadata;
    metadata.version = BDPT_VERSION;
    return metadata;
}

void write_exr_layer(const fs::path& file, const PixelHits& seen, std::string_view channels,
                     std::vector<float> values)
{
    const Layer layer{.name = "",
                      .channels = std::string(channels),
                      .width = seen.width,
                      .height = seen.height,
                      .values = std::move(values)};
    io::write_exr(file, layer, {.metadata = metadata_of_layers()});
}

/// Writes integers up to 65535 as a grey PNG file of 16 bits.
void write_integers(const fs::path& file, const PixelHits& seen,
                    std::span<const std::uint32_t> values)
{
    TexelImage image{.width = seen.width,
                     .height = seen.height,
                     .bytes = std::vector<std::uint8_t>(2 * values.size()),
                     .channels = 1,
                     .type = TexelType::unorm16};
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto value =
            static_cast<std::uint16_t>(std::min<std::uint32_t>(values[i], UINT16_MAX));
        std::memcpy(&image.bytes[2 * i], &value, sizeof(value));
    }
    io::write_png(file, image, {.metadata = metadata_of_layers()});
}

/// Reads what `write_integers` wrote.
TexelImage read_integers(const fs::path& file)
{
    TexelImage image = io::read_texels(file);
    if (image.channels != 1 || image.type != TexelType::unorm16) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("{}: no grey image of 16 bits", file.string()));
    }
    return image;
}

std::uint16_t integer_at(const TexelImage& image, std::size_t pixel)
{
    std::uint16_t value = 0;
    std::memcpy(&value, &image.bytes.at(2 * pixel + 1) - 1, sizeof(value));
    return value;
}

/// A camera, and the world's coordinates in those of the file.
struct Viewer {
    glm::mat3 camera_from_world;
    Vec3 eye;
    Vec3 axis;  ///< unit, forward
    DVec3 origin;

    Viewer(const CameraDesc& camera, const DVec3& origin_in_file)
        : eye(camera.world_from_camera[3]), origin(origin_in_file)
    {
        glm::mat3 axes(camera.world_from_camera);
        for (int i = 0; i < 3; ++i) {
            axes[i] = glm::normalize(axes[i]);
        }
        camera_from_world = glm::transpose(axes);
        axis = -axes[2];
    }
};

/// Returns the value of a layer at a surface; layers of one channel have it in x.
Vec3 value_of(DatasetLayer layer, const SurfaceHit& hit, const Viewer& viewer)
{
    const Vec3 facing = hit.is_front ? hit.shading_normal : -hit.shading_normal;
    switch (layer) {
        case DatasetLayer::depth:
            return Vec3(glm::dot(hit.position - viewer.eye, viewer.axis));
        case DatasetLayer::distance:
            return Vec3(hit.distance);
        case DatasetLayer::normal:
            return facing;
        case DatasetLayer::camera_normal:
            return viewer.camera_from_world * facing;
        case DatasetLayer::uv:
            return {hit.uv, 0.0f};
        case DatasetLayer::position:
            return Vec3(DVec3(hit.position) + viewer.origin);
        case DatasetLayer::mask:
        case DatasetLayer::flow:
            break;
    }
    return Vec3(0.0f);
}

std::vector<float> values_of(const FloatLayer& layer, const PixelHits& seen, const Viewer& viewer)
{
    const std::size_t count = layer.channels.size();
    std::vector<float> values;
    values.reserve(count * seen.hits.size());
    for (const std::optional<SurfaceHit>& hit : seen.hits) {
        const Vec3 value = hit ? value_of(layer.layer, *hit, viewer) : Vec3(layer.empty);
        for (std::size_t c = 0; c < count; ++c) {
            values.push_back(value[static_cast<int>(c)]);
        }
    }
    return values;
}

/// Writes depths in whole millimetres, up to 65535; 0 where there is no surface.
void write_millimetres(const fs::path& file, const PixelHits& seen, std::span<const float> depths)
{
    std::vector<std::uint32_t> integers;
    integers.reserve(depths.size());
    for (const float depth : depths) {
        const double rounded = std::round(static_cast<double>(depth) * millimetres);
        integers.push_back(std::isfinite(depth) ? static_cast<std::uint32_t>(
                                                      std::clamp(rounded, 0.0, most_of_16_bits))
                                                : 0);
    }
    write_integers(file, seen, integers);
}

/// Returns how COCO describes an instance: the pixels that are set in `mask`.
ordered_json annotation_of(const std::vector<bool>& mask, std::size_t width)
{
    const std::size_t height = mask.size() / width;
    std::size_t x0 = width;
    std::size_t y0 = height;
    std::size_t x1 = 0;
    std::size_t y1 = 0;
    std::size_t area = 0;
    std::vector<std::size_t> counts{0};  // of pixels outside, inside, outside, ..., by columns
    bool inside = false;
    for (std::size_t x = 0; x < width; ++x) {
        for (std::size_t y = 0; y < height; ++y) {
            const bool is_set = mask[y * width + x];
            if (is_set != inside) {
                counts.push_back(0);
                inside = is_set;
            }
            ++counts.back();
            if (is_set) {
                x0 = std::min(x0, x);
                y0 = std::min(y0, y);
                x1 = std::max(x1, x + 1);
                y1 = std::max(y1, y + 1);
                ++area;
            }
        }
    }
    return {{"bbox", {x0, y0, x1 - x0, y1 - y0}},
            {"area", area},
            {"segmentation", {{"size", {height, width}}, {"counts", counts}}},
            {"iscrowd", 0}};
}

}  // namespace

std::string_view mask_name(IdKind kind)
{
    for (const AovLayer& layer : aov_layers) {
        if (layer.aov == id_aovs[static_cast<std::size_t>(kind)]) {
            return layer.name;
        }
    }
    return "";
}

std::vector<std::string> view_files(const DatasetArguments& arguments, std::string_view number,
                                    bool is_last)
{
    std::vector<std::string> files{fmt::format("{}.{}", number, arguments.image_type)};
    for (const FloatLayer& layer : kinds_of_floats) {
        if (arguments.has(layer.layer)) {
            files.push_back(file_name(number, layer.name, "exr"));
        }
    }
    if (arguments.has(DatasetLayer::depth)) {
        files.push_back(file_name(number, "depth", "png"));
    }
    if (arguments.has(DatasetLayer::mask)) {
        for (const IdKind kind : id_kinds) {
            files.push_back(file_name(number, mask_name(kind), "png"));
        }
    }
    if (arguments.has(DatasetLayer::flow) && !is_last) {
        files.push_back(file_name(number, "flow", "exr"));
    }
    return files;
}

std::vector<LayerValues> float_layers(const DatasetArguments& arguments, const Scene& scene,
                                      const CameraDesc& camera, const PixelHits& seen)
{
    const Viewer viewer(camera, scene.description().origin);
    std::vector<LayerValues> layers;
    for (const FloatLayer& layer : kinds_of_floats) {
        if (arguments.has(layer.layer)) {
            layers.push_back({.name = layer.name,
                              .channels = layer.channels,
                              .values = values_of(layer, seen, viewer)});
        }
    }
    return layers;
}

void write_layers(const DatasetArguments& arguments, const fs::path& folder,
                  std::string_view number, const Scene& scene, const CameraDesc& camera,
                  const PixelHits& seen, std::span<const IdNumbers> masks)
{
    for (LayerValues& layer : float_layers(arguments, scene, camera, seen)) {
        if (layer.name == "depth") {
            write_millimetres(folder / file_name(number, "depth", "png"), seen, layer.values);
        }
        write_exr_layer(folder / file_name(number, layer.name, "exr"), seen, layer.channels,
                        std::move(layer.values));
    }
    for (std::size_t kind = 0; kind < masks.size(); ++kind) {
        write_integers(folder / file_name(number, mask_name(id_kinds.at(kind)), "png"), seen,
                       id_mask(seen, masks[kind]));
    }
}

void write_flow(const fs::path& folder, std::string_view number, const PixelHits& seen,
                std::span<const PixelFlow> flow)
{
    std::vector<float> values;
    values.reserve(3 * flow.size());
    for (const PixelFlow& pixel : flow) {
        values.insert(values.end(),
                      {pixel.motion.x, pixel.motion.y, pixel.is_visible ? 1.0f : 0.0f});
    }
    write_exr_layer(folder / file_name(number, "flow", "exr"), seen, "RGB", std::move(values));
}

std::vector<IdNumbers> mask_numbers(const DatasetArguments& arguments, const Scene& scene)
{
    std::vector<IdNumbers> masks;
    if (!arguments.has(DatasetLayer::mask)) {
        return masks;
    }
    for (const IdKind kind : id_kinds) {
        masks.push_back(id_numbers(scene, kind));
        const std::size_t count = masks.back().names.size() - 1;  // without that of 0
        if (count > UINT16_MAX) {
            throw Error(ErrorCode::unsupported,
                        fmt::format("{} names of {}s do not fit the 16 bits of a mask", count,
                                    mask_name(kind)));
        }
    }
    return masks;
}

void write_mask_names(const fs::path& folder, std::span<const IdNumbers> masks)
{
    ordered_json json = ordered_json::object();
    for (std::size_t kind = 0; kind < masks.size(); ++kind) {
        json[std::string(mask_name(id_kinds.at(kind)))] = masks[kind].names;
    }
    write_text(folder / "masks.json",
               json.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

void write_coco(const fs::path& file, std::span<const AnnotatedView> views)
{
    ordered_json images = ordered_json::array();
    ordered_json annotations = ordered_json::array();
    std::map<std::string, std::size_t> categories;  // ids by names
    for (const AnnotatedView& view : views) {
        const std::size_t image_id = images.size() + 1;
        const std::vector<std::string> names =
            io::JsonValue::read(view.mask_names).at("object").texts();
        const TexelImage instances = read_integers(view.instances);
        const TexelImage objects = read_integers(view.objects);
        images.push_back({{"id", image_id},
                          {"file_name", view.image},
                          {"width", instances.width},
                          {"height", instances.height}});
        const auto width = static_cast<std::size_t>(instances.width);
        const std::size_t pixels = width * static_cast<std::size_t>(instances.height);
        struct Found {
            std::vector<bool> mask;
            std::size_t object = 0;
        };
        std::map<std::uint16_t, Found> found;
        for (std::size_t i = 0; i < pixels; ++i) {
            if (const std::uint16_t instance = integer_at(instances, i); instance != 0) {
                Found& thing = found[instance];
                if (thing.mask.empty()) {
                    thing = {.mask = std::vector<bool>(pixels), .object = integer_at(objects, i)};
                }
                thing.mask[i] = true;
            }
        }
        for (const auto& [instance, thing] : found) {
            const auto [category, is_new] =
                categories.try_emplace(names.at(thing.object), categories.size() + 1);
            ordered_json annotation{{"id", annotations.size() + 1},
                                    {"image_id", image_id},
                                    {"category_id", category->second},
                                    {"instance", instance}};
            annotation.update(annotation_of(thing.mask, width));
            annotations.push_back(std::move(annotation));
        }
    }
    ordered_json kinds = ordered_json::array();
    for (const auto& [name, id] : categories) {
        kinds.push_back({{"id", id}, {"name", name}});
    }
    std::sort(kinds.begin(), kinds.end(), [](const ordered_json& a, const ordered_json& b) {
        return a.at("id").get<std::size_t>() < b.at("id").get<std::size_t>();
    });
    const ordered_json json{{"info", {{"description", "bdpt dataset"}, {"version", BDPT_VERSION}}},
                            {"images", images},
                            {"annotations", annotations},
                            {"categories", kinds}};
    write_text(file, json.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace bdpt::job
