#pragma once

/// Exports symbols that users of the shared library may call or catch; all others are hidden.
#define BDPT_EXPORT [[gnu::visibility("default")]]

/// Marks a declaration that may change in any minor version; all others last until version 2.
#define BDPT_EXPERIMENTAL
