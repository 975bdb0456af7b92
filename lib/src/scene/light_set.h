#pragma once

#include "light/intensity_profile.h"
#include "light/learned/learned_light.h"
#include "light/light.h"
#include "math/distributions.h"
#include "scene/next_event_lights.h"

#include <bdpt/scene_desc.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace bdpt {

/// Returns the maximum number of samples of its emission texture that a triangle may take along
/// each side, so that the total time stays around a second. `placed[i]` has material
/// `material_ids[i]`.
[[nodiscard]] int max_emission_samples(std::span<const MaterialId> material_ids,
                                       std::span<const PlacedMesh> placed,
                                       std::span<const Material> materials);

/// Returns the spheres of the point and spot lights that have a radius, in order; `lights` must
/// outlive them.
[[nodiscard]] std::vector<Sphere> light_spheres(std::span<const LightDesc> lights);

/// All lights of a scene and the choice of one of them. Starting a light path and next-event
/// estimation choose with two different densities: only the second depends on a receiver.
class LightSet {
public:
    using Choice = NextEventLights::Choice;

    /// `placed[i]` has material `material_ids[i]`, and `lights[i]` lies in `media[i]`. All
    /// arguments but these two lists must outlive this object.
    LightSet(std::span<const MaterialId> material_ids, std::span<const PlacedMesh> placed,
             std::span<const Material> materials, std::span<const LightDesc> lights,
             std::span<const IntensityProfile> profiles, const BoundingSphere& bounds,
             std::span<const MediumId> media);

    [[nodiscard]] std::size_t size() const { return lights_.size(); }
    [[nodiscard]] const Light& operator[](LightId id) const
    {
        return lights_[static_cast<std::size_t>(id)];
    }

    /// Chooses a light in proportion to power; nullopt if no light has any.
    [[nodiscard]] std::optional<Choice> choose_for_emission(Vec2 u) const
    {
        return choose(by_power_, u);
    }
    /// A light, and the remaining random numbers for a point on it, uniform in [0, 1)^2.
    struct ChoiceAndNumbers {
        LightId id{};
        float probability = 0.0f;
        Vec2 u{0.0f};
    };
    /// Chooses a light in the proportions that were learned, if any, else by power. Uses `u` and
    /// returns the remainder if there are few lights; otherwise uses the number from `draw_fine()`.
    template <typename DrawFine>
    [[nodiscard]] std::optional<ChoiceAndNumbers> choose_for_emission(
        Vec2 u, const DrawFine& draw_fine, const LearnedLight* learned = nullptr) const
    {
        const AliasTable& table = starts(learned);
        if (lights_.size() > few_lights) {
            const auto choice = choose(table, draw_fine());
            return choice ? std::optional(ChoiceAndNumbers{choice->id, choice->probability, u})
                          : std::nullopt;
        }
        if (table.empty()) {
            return std::nullopt;
        }
        const auto choice = table.sample_coarse(u.x);
        return ChoiceAndNumbers{
            LightId{choice.index}, choice.probability, {choice.u_remapped, u.y}};
    }
    /// Returns the probability of that choice.
    [[nodiscard]] float emission_probability(LightId id,
                                             const LearnedLight* learned = nullptr) const
    {
        // Triangles may emit so little that no light has any power in the range of floats.
        const AliasTable& table = starts(learned);
        return table.empty() ? 0.0f : table.probability(static_cast<std::uint32_t>(id));
    }
    /// Starts a light path at the light that `choose_for_emission` chose, where its light enters
    /// the scene as learned, if it is at infinity.
    [[nodiscard]] std::optional<EmissionSample> sample_emission(const ChoiceAndNumbers& choice,
                                                                Vec2 u_direction,
                                                                const LearnedLight* learned,
                                                                float time) const;
    /// Densities with which a light path starts at a point on a light and goes to another point.
    struct EmissionPdfs {
        AreaPdf position;         ///< `Light::pdf_position`, times the probability of the light
        SolidAnglePdf direction;  ///< of finite lights
        PlanarPdf entry;          ///< of lights at infinity
    };
    /// Returns them for x_0 and a point `p`, from which light `id` is in direction `to_light`.
    [[nodiscard]] EmissionPdfs emission_pdfs(LightId id, const LightPoint& x0, Vec3 p,
                                             Vec3 to_light, const LearnedLight* learned) const;

    /// A point on a light sampled by next-event estimation.
    struct NextEvent {
        LightId light{};
        float probability = 0.0f;  ///< probability of this light
        /// Densities and weight are conditional on the light. nullopt if no light that can
        /// illuminate the receiver was found.
        std::optional<IncidentSample> incident;

        /// Returns `next_event_pdf` of the point, if there is one.
        [[nodiscard]] AreaPdf pdf() const { return incident->pdf * probability; }
    };
    /// Samples a point on a light. `draw_fine()` as for emission.
    template <typename DrawFine>
    [[nodiscard]] NextEvent sample_next_event(const LightSampleContext& receiver, Vec2 u,
                                              const DrawFine& draw_fine,
                                              const NextEventSampling& sampling, float time) const
    {
        const GroupShares::Shares* shares = learned_shares(receiver, sampling);
        const auto choice = shares != nullptr
                                ? choose_by_groups(receiver, u, draw_fine, *shares)
                                : choose_for_context(receiver, u, draw_fine, sampling.lights);
        if (!choice) {
            return {};
        }
        // Constructed in place: a copy would take longer than the choice.
        return {.light = choice->id,
                .probability = choice->probability,
                .incident = (*this)[choice->id].sample_incident(
                    with_visibility(receiver, choice->id, sampling), choice->u,
                    sampling.environments, time)};
    }
    /// Returns the density with which next-event estimation at the receiver samples the point `x0`
    /// on light `id`; in the measure of `IncidentSample::pdf`.
    [[nodiscard]] AreaPdf next_event_pdf(LightId id, const LightPoint& x0,
                                         const LightSampleContext& receiver,
                                         const NextEventSampling& sampling) const
    {
        return (*this)[id].pdf_incident(with_visibility(receiver, id, sampling), x0,
                                        sampling.environments) *
               next_event_probability(id, receiver, sampling);
    }
    /// The density's first half: of choosing light `id`.
    [[nodiscard]] float next_event_probability(LightId id, const LightSampleContext& receiver,
                                               const NextEventSampling& sampling) const
    {
        const GroupShares::Shares* shares = learned_shares(receiver, sampling);
        return shares != nullptr ? next_event_.probability(id, receiver, *shares)
                                 : context_probability(id, receiver, sampling.lights);
    }

    /// Chooses a light for the receiver, the first step of next-event estimation.
    [[nodiscard]] std::optional<Choice> choose_for_context(const LightSampleContext& receiver,
                                                           Vec2 u, LightSampling sampling) const
    {
        return uses_tree(sampling) ? next_event_.choose(receiver, fine_uniform(u))
                                   : choose_for_emission(u);
    }
    /// Chooses a light for the receiver and returns the remaining random numbers, as for emission.
    template <typename DrawFine>
    [[nodiscard]] std::optional<ChoiceAndNumbers> choose_for_context(
        const LightSampleContext& receiver, Vec2 u, const DrawFine& draw_fine,
        LightSampling sampling) const
    {
        if (!uses_tree(sampling)) {
            return choose_for_emission(u, draw_fine);
        }
        const auto choice = next_event_.choose(receiver, fine_uniform(draw_fine()));
        return choice ? std::optional(ChoiceAndNumbers{choice->id, choice->probability, u})
                      : std::nullopt;
    }
    /// Chooses one of the lights with a position by the tree, as if there were no others.
    [[nodiscard]] std::optional<Choice> choose_placed(const LightSampleContext& receiver,
                                                      double u) const
    {
        return next_event_.choose_placed(receiver, u);
    }
    /// Tests whether any light with a position has power.
    [[nodiscard]] bool has_placed() const { return next_event_.placed_count() > 0; }
    /// Returns the probability of choosing light `id` for the receiver; positive if it can
    /// illuminate the receiver.
    [[nodiscard]] float context_probability(LightId id, const LightSampleContext& receiver,
                                            LightSampling sampling) const
    {
        return uses_tree(sampling) ? next_event_.probability(id, receiver)
                                   : emission_probability(id);
    }
    /// Tests whether lights are chosen by the tree, resolving `automatic`.
    [[nodiscard]] bool uses_tree(LightSampling sampling) const
    {
        return sampling == LightSampling::tree ||
               (sampling == LightSampling::automatic && prefers_tree_);
    }

    /// The groups of lights that next-event estimation chooses from.
    [[nodiscard]] const NextEventLights& next_event_lights() const { return next_event_; }

    /// The light that rays find which leave the scene.
    [[nodiscard]] std::optional<LightId> environment() const { return environment_; }
    /// Returns the light of an emissive triangle; nullopt for others.
    [[nodiscard]] std::optional<LightId> of_triangle(std::uint32_t instance,
                                                     std::uint32_t triangle) const;
    /// Returns the light of sphere `sphere` of `light_spheres`.
    [[nodiscard]] LightId of_sphere(std::uint32_t sphere) const { return spheres_[sphere]; }

private:
    /// Maximum number of lights for which one float has enough digits for a choice and a point.
    static constexpr std::size_t few_lights = 64;

    /// Returns the table that chooses the light of a light path.
    [[nodiscard]] const AliasTable& starts(const LearnedLight* learned) const
    {
        return learned != nullptr && learned->starts ? *learned->starts : by_power_;
    }
    [[nodiscard]] static std::optional<Choice> choose(const AliasTable& table, Vec2 u);
    /// Returns where light of an environment enters the scene, as learned; null if that is unknown.
    [[nodiscard]] const EnvironmentEntries* learned_entries(LightId id,
                                                            const LearnedLight* learned) const;

    /// Returns the learned shares of the groups of lights; null if none were learned.
    [[nodiscard]] static const GroupShares::Shares* learned_shares(
        const LightSampleContext& receiver, const NextEventSampling& sampling)
    {
        return sampling.learned != nullptr && sampling.learned->groups
                   ? &sampling.learned->groups->at(receiver.p)
                   : nullptr;
    }
    template <typename DrawFine>
    [[nodiscard]] std::optional<ChoiceAndNumbers> choose_by_groups(
        const LightSampleContext& receiver, Vec2 u, const DrawFine& draw_fine,
        const GroupShares::Shares& shares) const
    {
        const auto choice = next_event_.choose(receiver, fine_uniform(draw_fine()), shares);
        return choice ? std::optional(ChoiceAndNumbers{choice->id, choice->probability, u})
                      : std::nullopt;
    }
    /// The receiver, with what is visible from it if light `id` is an environment whose visibility
    /// was learned.
    [[nodiscard]] LightSampleContext with_visibility(LightSampleContext receiver, LightId id,
                                                     const NextEventSampling& sampling) const
    {
        if (sampling.learned != nullptr && sampling.learned->visibility && environment_ == id) {
            receiver.visibility = &sampling.learned->visibility->at(receiver.p);
        }
        return receiver;
    }

    BoundingSphere bounds_;
    std::vector<Light> lights_;
    std::vector<std::optional<std::uint32_t>> first_of_instance_;
    std::vector<LightId> spheres_;
    std::optional<LightId> environment_;
    AliasTable by_power_;
    NextEventLights next_event_;
    bool prefers_tree_ = false;
};

}  // namespace bdpt
