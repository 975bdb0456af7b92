#pragma once

#include "light/environment/environment_tiles.h"
#include "light/learned/entries.h"
#include "light/learned/place_tree.h"
#include "light/light_samples.h"
#include "math/distributions.h"

#include <bdpt/part/identity.h>
#include <bdpt/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace bdpt {

/// Visibility of each tile of an environment from a place, by cells of a kd-tree that a pilot
/// filled (docs/decisions/0068-learned-visibility.md). It guides next-event estimation and cannot
/// bias it: no factor is zero.
class EnvironmentVisibility {
public:
    /// A visibility ray towards an environment.
    struct Trial {
        Vec3 p{0.0f};  ///< origin in world space
        std::uint32_t tile = 0;
        bool visible = false;  ///< true if it hit nothing
    };

    /// Builds the tree from `trials`, whose order does not matter. Without any, everything is
    /// visible.
    explicit EnvironmentVisibility(std::vector<Trial> trials);

    /// Factors of the tiles' shares of the samples at `p`, in [min_factor, 1].
    [[nodiscard]] const TileFactors& at(Vec3 p) const noexcept { return cells_.at(p); }
    /// Number of cells that space is divided into.
    [[nodiscard]] std::size_t cells() const noexcept { return cells_.size(); }

    /// Factor of a tile that no ray reached: its light is still sampled, if rarely.
    static constexpr float min_factor = 0.05f;

private:
    PlaceTree<TileFactors> cells_;
};

/// Probabilities with which next-event estimation chooses a group of lights (`NextEventLights`), by
/// cells of a kd-tree that a pilot filled: in proportion to the root mean square of the
/// contributions of each group (docs/decisions/0071-learned-groups-of-lights.md). None is zero.
class GroupShares {
public:
    static constexpr std::size_t max_groups = 8;
    /// The probability of each group; they add up to one.
    using Shares = std::array<float, max_groups>;

    /// A light sample of one group.
    struct Finding {
        Vec3 p{0.0f};  ///< position of the receiver in world space
        std::uint32_t group = 0;
        float value = 0.0f;  ///< its contribution, >= 0 and finite
    };

    /// Learns the shares of `groups` groups. The order of `findings` does not matter. If all are
    /// black, all shares are equal.
    GroupShares(std::vector<Finding> findings, std::size_t groups);

    [[nodiscard]] const Shares& at(Vec3 p) const noexcept { return cells_.at(p); }
    /// Number of cells that space is divided into.
    [[nodiscard]] std::size_t cells() const noexcept { return cells_.size(); }

    /// The part of the choice that is uniform, whatever was found.
    static constexpr double even_part = 0.1;

private:
    PlaceTree<Shares> cells_;
};

/// Where the parallel light of a sun enters the scene.
struct SunEntries {
    LightId sun{};
    EntryWindow window;
};

/// The directions and lights from which light arrives, by position, as learned by a pilot.
/// Light sampling follows them; they cannot bias an image, whatever they say.
struct LearnedLight {
    /// Visibility of the environment; nullopt if it is equally visible everywhere, or nowhere.
    std::optional<EnvironmentVisibility> visibility{};
    /// Shares of groups of lights; nullopt if there is only one group, or no light was found.
    std::optional<GroupShares> groups{};
    /// Chooses the light of each light path; nullopt if there is one lamp only, or no indirect
    /// light was found.
    std::optional<AliasTable> starts{};
    /// Where light of the environment enters the scene; nullopt without `visibility`.
    std::optional<EnvironmentEntries> entries{};
    /// Of directional lights, of which some light was found.
    std::vector<SunEntries> suns{};
};

/// The last result of the light pilot of a scene, so that the choice of an integrator and all
/// renders of the same view learn it once. The result is a pure function of scene and `Inputs`, so
/// images do not depend on whether it was learned or remembered. Thread-safe.
class LearnedMemo {
public:
    /// Everything that the result depends on beside the scene.
    using Inputs = std::vector<IdentityComponent>;
    /// Null if the pilot found nothing that helps.
    using Learned = std::shared_ptr<const LearnedLight>;

    /// Returns the result for these inputs; nullopt if the last inputs differ.
    [[nodiscard]] std::optional<Learned> find(const Inputs& inputs) const
    {
        const std::lock_guard lock(mutex_);
        return inputs_ == inputs ? std::optional(learned_) : std::nullopt;
    }
    /// Replaces the remembered result.
    void keep(Inputs inputs, Learned learned)
    {
        const std::lock_guard lock(mutex_);
        inputs_ = std::move(inputs);
        learned_ = std::move(learned);
    }

private:
    mutable std::mutex mutex_;
    std::optional<Inputs> inputs_;
    Learned learned_;
};

}  // namespace bdpt
