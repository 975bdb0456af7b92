#include <bdpt/io/gltf.h>

#include "file/load_context.h"
#include "file/named_errors.h"
#include "gltf/animation/animation.h"
#include "gltf/document/facts.h"
#include "gltf/document/prepass.h"
#include "gltf/document/selection.h"
#include "gltf/scene/scene_builder.h"
#include "image/ktx2_decoder.h"

#include <utility>
#include <vector>

namespace bdpt::io {

namespace {

LoadedScene load(const std::filesystem::path& file, const GltfOptions& options)
{
    LoadContext context{.folders = {.own = file.parent_path(), .allowed = options.allowed_folders},
                        .limits = options.limits,
                        .memory = options.memory};
    check_folders(context.folders);
    context.images = options.images.get();
    Ktx2Decoder ktx2(options.ktx_library);
    context.ktx2 = &ktx2;
    context.ignore_required = options.ignore_required;
    CheckedGltf checked = read_checked_gltf(file, context);
    GltfFacts facts = collect_facts(checked);
    facts.scene = select_scene(checked.document, options.scene);
    if (!facts.scene) {
        context.warn("the file has no scene; all its nodes are shown", "/scenes");
    }
    std::vector<std::filesystem::path> files = std::move(checked.files);
    SceneChoice choice;
    choice.scene = facts.scene;
    if (options.variant) {
        choice.variant = select("variant", facts.variant_names, *options.variant);
    }
    choice.animations = select_animations(facts.animation_names, options, context);
    choice.time = options.time.value_or(0.0);
    choice.shutter = options.shutter.value_or(Shutter{});
    LoadedScene loaded = build_scene(std::move(checked), choice, options.on_progress, context);
    loaded.facts = std::move(facts);
    loaded.files = std::move(files);
    if (options.strict) {
        context.warnings.refuse_harm();
    }
    loaded.warnings = context.warnings.lines();
    loaded.notes = context.warnings.drafts();
    return loaded;
}

}  // namespace

LoadedScene load_gltf(const std::filesystem::path& file, const GltfOptions& options)
{
    return with_named_errors(file, [&] { return load(file, options); });
}

}  // namespace bdpt::io
