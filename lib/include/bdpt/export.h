#pragma once

/// Exports symbols that users of the shared library may call or catch; all others are hidden.
#define BDPT_EXPORT [[gnu::visibility("default")]]
