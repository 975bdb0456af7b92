#pragma once

#include "material/layers.h"
#include "material/small_numbers.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace bdpt {

/// The layered models that a thread made last. Vertices store only parameters, from which each of
/// their calls needs the model: to evaluate light samples, to sample a direction, for connections.
/// A model is a pure function of its parameters, so it does not matter which are kept.
template <typename Model>
class RecentModels {
public:
    /// Returns the model of these parameters on a facet with this macroscopic normal; `make()`
    /// makes it, if it is not kept. Valid until the next call.
    template <typename Make>
    [[nodiscard]] const Model& get(const LayeredParameters& parameters, const Direction16& macro,
                                   const Make& make)
    {
        for (const std::optional<Entry>& entry : entries_) {
            // The constants of another scene may have been at the same address.
            if (entry && entry->constants == parameters.constants->id && entry->macro == macro &&
                entry->parameters == parameters) {
                return entry->model;
            }
        }
        std::optional<Entry>& entry = entries_[next_];
        next_ = (next_ + 1) % entries_.size();
        return entry.emplace(Entry{parameters, macro, parameters.constants->id, make()}).model;
    }

private:
    struct Entry {
        LayeredParameters parameters;
        Direction16 macro;
        std::uint64_t constants;
        Model model;
    };

    std::array<std::optional<Entry>, 4> entries_{};  // of a camera vertex, and of light vertices
    std::size_t next_ = 0;
};

}  // namespace bdpt
