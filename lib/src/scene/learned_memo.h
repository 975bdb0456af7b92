#pragma once

#include "light/learned/learned_light.h"

#include <bdpt/part/identity.h>

#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace bdpt {

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
