#include "scene/world_builder.h"

#include "identity/same_bits.h"
#include "material/specular_albedo.h"
#include "math/rgb.h"
#include "scene/checks/validate.h"
#include "scene/light_set.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <variant>

namespace bdpt {
namespace {

bool light_moves(const LightDesc& light)
{
    return std::visit(
        [](const auto& l) {
            bool moves = false;
            if constexpr (requires { l.motion; }) {
                moves = moves || !l.motion.empty();
            }
            if constexpr (requires { l.later_directions; }) {
                moves = moves || !l.later_directions.empty();
            }
            return moves;
        },
        light);
}

}  // namespace

void WorldBuilder::build(Isa isa)
{
    World& w = world_;
    validate(w.desc_, like_ != nullptr ? like_->desc_ : SharedSceneDesc());
    if (like_ != nullptr && like_->geometry_->fits(w.desc_)) {
        w.set_geometry(like_->geometry_);
    } else {
        own_geometry_ = std::make_shared<SceneGeometry>(
            w.desc_, like_ != nullptr ? like_->geometry_.get() : nullptr);
        w.set_geometry(own_geometry_);
    }
    w.moves_ = std::any_of(w.placed_.begin(), w.placed_.end(),
                           [](const PlacedMesh& mesh) { return mesh.moves(); }) ||
               std::any_of(w.desc_.lights.begin(), w.desc_.lights.end(), light_moves);
    if (w.desc_.fog) {
        w.fog_ = w.media_.add_fog(make_medium(*w.desc_.fog), w.geometry_->sphere);
    }
    w.volumes_ = is_shared(&SharedSceneDesc::volumes) ? Volumes(like_->volumes_)
                                                      : Volumes(w.desc_.volumes.values());
    add_materials();
    build_trees(isa);
    for (std::uint32_t i = 0; i < w.placed_.size(); ++i) {
        w.has_passable_surfaces_ = w.has_passable_surfaces_ || w.may_be_passed(i);
        w.has_tinted_surfaces_ = w.has_tinted_surfaces_ || w.may_tint(i);
    }
    w.warnings_ = precision_warnings(w.desc_, *w.geometry_);
    find_enclosing_volumes();
    give_bonds();
    measure_bodies();
    add_lights();
}

/// Reuses the BVHs of `like_` if the geometry and its filter are the same.
void WorldBuilder::build_trees(Isa isa)
{
    World& w = world_;
    const AnyHitFilter filter = w.any_hit_filter();
    if (!own_geometry_ &&
        w.geometry_->trees->filtered() !=
            filtered_meshes(w.geometry_->traced.values(), w.geometry_->traced_meshes(), filter)) {
        own_geometry_ = std::make_shared<SceneGeometry>(
            w.desc_, like_ != nullptr ? like_->geometry_.get() : nullptr);
        w.set_geometry(own_geometry_);
    }
    if (own_geometry_) {
        own_geometry_->build(filter, isa, like_ != nullptr ? like_->geometry_.get() : nullptr);
    }
    w.embree_ = std::make_unique<const EmbreeScene>(*w.geometry_->trees, filter);
}

void WorldBuilder::add_materials()
{
    World& w = world_;
    const SharedList<MaterialDesc>& materials = w.desc_.materials;
    if (is_shared(&SharedSceneDesc::images)) {
        w.mip_maps_ = like_->mip_maps_;
    }
    if (std::any_of(materials.begin(), materials.end(), has_layers)) {
        const LayerTables* known = like_ != nullptr ? like_->layer_tables_.get() : nullptr;
        w.layer_tables_ = known != nullptr && known->are_enough_for(materials.values())
                              ? like_->layer_tables_
                              : std::make_shared<const LayerTables>(materials.values());
    }
    for (std::size_t i = 0; i < materials.size(); ++i) {
        is_known_desc_.push_back(is_known(i));
    }
    w.all_materials_->reserve(materials.size());
    const Exterior outside{.medium = w.fog_};
    for (std::size_t i = 0; i < materials.size(); ++i) {
        add_material(i, outside);
    }
    for (const InstanceDesc& instance : w.desc_.instances) {
        w.material_ids_.push_back(instance.material);
    }
}

/// Tests whether `like_` has the same material, apart from its name.
bool WorldBuilder::is_known(std::size_t material) const
{
    const SharedSceneDesc& desc = world_.desc_;
    return is_shared(&SharedSceneDesc::images) &&
           desc.texture_filter == like_->desc_.texture_filter &&
           material < like_->desc_.materials.size() &&
           same_bits(desc.materials[material], like_->desc_.materials[material]) &&
           (!has_layers(desc.materials[material]) || world_.layer_tables_ == like_->layer_tables_);
}

/// Adds a material; `number` is the index of its description.
void WorldBuilder::add_material(std::size_t number, const Exterior& exterior)
{
    World& w = world_;
    const MaterialDesc& desc = w.desc_.materials[number];
    const MediumId within = w.media_.add(medium_within(desc));
    const World::MaterialSource source{number, exterior, within};
    std::optional<std::size_t> known;
    if (is_known_desc_[number]) {
        const auto& sources = like_->material_sources_;
        const auto first = std::find(sources.begin(), sources.end(), source);
        known = first != sources.end()
                    ? std::optional(static_cast<std::size_t>(first - sources.begin()))
                    : std::nullopt;
    }
    const std::size_t id = w.all_materials_->size();
    is_kept_.push_back(known == id);
    const ChannelAlbedos albedos = find_albedos(desc, exterior);
    w.all_materials_->push_back(known ? (*like_->all_materials_)[*known]
                                      : make_material(desc, albedos, exterior, within));
    w.materials_ = *w.all_materials_;
    w.material_sources_.push_back(source);
    w.disperses_ = w.disperses_ || w.materials_.back().disperses();
}

Material WorldBuilder::make_material(const MaterialDesc& desc, const ChannelAlbedos& albedos,
                                     const Exterior& exterior, MediumId within)
{
    World& w = world_;
    const bool mip_mapped = w.desc_.texture_filter == TextureFilter::mip_mapped;
    const TextureImages texture_images(w.desc_.images.values(),
                                       mip_mapped ? &w.mip_maps_ : nullptr);
    return {desc, texture_images, albedos, w.layer_tables_.get(), exterior, within};
}

ChannelAlbedos WorldBuilder::find_albedos(const MaterialDesc& desc, const Exterior& exterior)
{
    const auto [red, green, blue] = boundary_indices(desc, exterior).greater_by_less;
    return {find_albedo(red), find_albedo(green), find_albedo(blue)};
}

/// Returns the table of this scene or of the scene that it was edited from, or else a new one.
const SpecularAlbedo& WorldBuilder::find_albedo(float ior)
{
    std::shared_ptr<const SpecularAlbedo>& albedo = world_.albedos_[ior];
    if (!albedo && like_ != nullptr) {
        const auto known = like_->albedos_.find(ior);
        albedo = known != like_->albedos_.end() ? known->second : nullptr;
    }
    if (!albedo) {
        albedo = std::make_shared<const SpecularAlbedo>(ior);
    }
    return *albedo;
}

/// Returns the medium around each light; for those at infinity, the one where their rays enter the
/// scene.
std::vector<MediumId> WorldBuilder::media_around(const SharedList<LightDesc>& lights) const
{
    std::vector<MediumId> media;
    for (const LightDesc& light : lights) {
        media.push_back(std::visit(
            [this](const auto& desc) {
                if constexpr (requires { desc.position; }) {
                    return world_.medium_at(desc.position);
                }
                return world_.fog_;
            },
            light));
    }
    return media;
}

/// Tests whether triangles emit the same light as in `like_`, whose lights then refer to materials
/// and meshes that still exist.
bool WorldBuilder::emission_stays() const
{
    const World& w = world_;
    if (like_ == nullptr || w.geometry_ != like_->geometry_ ||
        max_emission_samples(w.material_ids_, w.placed_, w.materials_) !=
            max_emission_samples(like_->material_ids_, like_->placed_, like_->materials_)) {
        return false;
    }
    for (std::size_t i = 0; i < w.placed_.size(); ++i) {
        const auto now = static_cast<std::size_t>(w.material_ids_[i]);
        const auto before = static_cast<std::size_t>(like_->material_ids_[i]);
        const bool dark = is_black(w.materials_[now].mean_emission()) &&
                          is_black(like_->materials_[before].mean_emission());
        if (!dark && !(now == before && is_kept_[now])) {
            return false;
        }
    }
    return true;
}

void WorldBuilder::add_lights()
{
    World& w = world_;
    const SharedSceneDesc& desc = w.desc_;
    w.counts_ = w.geometry_->counts;
    const std::vector<MediumId> media = media_around(desc.lights);
    if (is_shared(&SharedSceneDesc::lights) && is_shared(&SharedSceneDesc::profiles) &&
        emission_stays() && media == like_->lit_->media) {
        w.lit_ = like_->lit_;
    } else {
        const auto lit = std::make_shared<World::Lit>();
        lit->materials = w.all_materials_;
        lit->media = media;
        lit->profiles.reserve(desc.profiles.size());
        for (const LightProfile& profile : desc.profiles) {
            lit->profiles.emplace_back(profile);
        }
        lit->lights.emplace(w.material_ids_, w.placed_, w.materials_, desc.lights.values(),
                            lit->profiles, w.geometry_->sphere, media);
        check_powers(desc, w.material_ids_, w.materials_, *lit->lights);
        w.lit_ = lit;
    }
    w.lights_ = &*w.lit_->lights;
    w.counts_.lights = w.lights_->size();
    w.counts_.emissive_triangles = w.lights_->size() - desc.lights.size();
    if (w.counts_.lights == 0) {
        w.warnings_.emplace_back("no light: the image will be black");
    }
}

}  // namespace bdpt
