#pragma once

#include <bdpt/options/option_fields.h>

#include <span>
#include <string_view>

#include "options/option_list.h"

namespace bdpt::app {

// Options of the command that are fields of `RenderOptions`, generated from the list in
// <bdpt/options/option_fields.h>: a field with a help text there is an option here.

void add_fields(OptionList& options, FilmOptions& film);
void add_fields(OptionList& options, SamplingOptions& sampling);
void add_fields(OptionList& options, TransportOptions& transport);
void add_fields(OptionList& options, BidirectionalOptions& bidirectional);
void add_fields(OptionList& options, SystemOptions& system);

/// Adds the fields `names`, such as "light_samples", of all groups.
void add_fields(OptionList& options, RenderOptions& render,
                std::span<const std::string_view> names);

}  // namespace bdpt::app
