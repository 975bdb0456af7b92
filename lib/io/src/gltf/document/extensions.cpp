#include "gltf/document/document.h"

#include "file/read_file.h"
#include "gltf/checks/extension_table.h"
#include "gltf/compression/compression.h"
#include "image/encoded_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <string>

namespace bdpt::io {

namespace {

using enum ExtensionStatus;

/// Tests whether this build lacks the library for an extension.
bool is_missing(std::string_view name)
{
    return (name == "KHR_draco_mesh_compression" && !has_draco()) ||
           (name.ends_with("_meshopt_compression") && !has_meshopt());
}

/// Tests for extensions without which there is no sensible mesh.
bool is_about_meshes(std::string_view name)
{
    return name == "KHR_draco_mesh_compression" || name.ends_with("_meshopt_compression") ||
           name == "KHR_mesh_quantization";
}

bool is_read(ExtensionStatus status)
{
    return status == supported || status == draft;
}

/// Returns why a file that requires an extension cannot be loaded as intended; none: it can.
std::optional<std::string> obstacle_to(const ExtensionUse& use, LoadContext& context)
{
    if (is_missing(use.name)) {
        return fmt::format("requires {}, which this build cannot decode", quote(use.name));
    }
    if (!is_read(use.status)) {
        return fmt::format("requires {}, which is not supported", quote(use.name));
    }
    if (use.name == "KHR_texture_basisu" && context.ktx2 != nullptr) {
        if (const std::string* const obstacle = context.ktx2->obstacle()) {
            return fmt::format("requires {}, KTX2 textures: {}", quote(use.name), *obstacle);
        }
    }
    return std::nullopt;
}

ExtensionUse describe(const JsonPlace& place)
{
    if (!place.value().is_string()) {
        place.fail("must be a string, but is " + brief(place.value()));
    }
    const auto& name = place.value().get_ref<const std::string&>();
    const auto* found = std::ranges::find(extension_table, name, &ExtensionSupport::name);
    if (found == std::end(extension_table)) {
        return {name, unknown, false, ""};
    }
    if (is_missing(name)) {
        return {name, ignored, false,
                "this build cannot decode it; only uncompressed data is read"};
    }
    return {name, found->status, false, std::string(found->note)};
}

}  // namespace

std::vector<ExtensionUse> list_extensions(const JsonPlace& root)
{
    std::vector<ExtensionUse> uses;
    for (const char* list : {"extensionsRequired", "extensionsUsed"}) {
        if (!root.has(list)) {
            continue;
        }
        const JsonPlace names = root.member(list);
        for (std::size_t i = 0; i < names.size(); ++i) {
            const JsonPlace place = names.element(i);
            if (!place.value().is_string()) {
                continue;
            }
            ExtensionUse use = describe(place);
            use.required = std::string_view(list) == "extensionsRequired";
            if (std::none_of(uses.begin(), uses.end(), [&use](const ExtensionUse& other) {
                    return other.name == use.name;
                })) {
                uses.push_back(std::move(use));
            }
        }
    }
    return uses;
}

std::vector<ExtensionUse> check_extensions(const JsonPlace& root, LoadContext& context)
{
    std::vector<ExtensionUse> uses;
    const auto find = [&uses](const std::string& name) {
        return std::find_if(uses.begin(), uses.end(),
                            [&name](const ExtensionUse& use) { return use.name == name; });
    };
    const auto add = [&](ExtensionUse use, const JsonPlace& place) {
        if (use.status == draft) {
            context.warn(WarningKind::draft,
                         fmt::format("extension {} is a draft, which may change", use.name),
                         place.pointer());
        }
        uses.push_back(std::move(use));
    };
    if (root.has("extensionsRequired")) {
        const JsonPlace required = root.member("extensionsRequired");
        for (std::size_t i = 0; i < required.size(); ++i) {
            const JsonPlace place = required.element(i);
            ExtensionUse use = describe(place);
            if (const auto obstacle = obstacle_to(use, context)) {
                const bool may_ignore = !is_about_meshes(use.name);
                if (!context.ignore_required || !may_ignore) {
                    place.fail("the file " + *obstacle +
                                   (may_ignore ? " (--ignore-required renders it without)" : ""),
                               ErrorCode::unsupported);
                }
                context.warn(WarningKind::loss, "loaded without what the file requires",
                             place.pointer() + ": it " + *obstacle);
            }
            use.required = true;
            if (find(use.name) == uses.end()) {
                add(std::move(use), place);
            }
        }
    }
    if (root.has("extensionsUsed")) {
        const JsonPlace used = root.member("extensionsUsed");
        for (std::size_t i = 0; i < used.size(); ++i) {
            const JsonPlace place = used.element(i);
            ExtensionUse use = describe(place);
            if (find(use.name) != uses.end()) {
                continue;
            }
            if (!is_read(use.status)) {
                context.warn(
                    WarningKind::loss,
                    fmt::format("extension {} is {}{}", use.name,
                                use.status == ignored ? "ignored: " : "unknown and ignored",
                                use.note),
                    place.pointer());
            }
            add(std::move(use), place);
        }
    }
    return uses;
}

std::string_view to_string(ExtensionStatus status)
{
    constexpr std::array<std::string_view, 4> names{"supported", "draft", "ignored", "unknown"};
    return names[static_cast<std::size_t>(status)];
}

}  // namespace bdpt::io
