#pragma once

#include "albedo/table.h"
#include "renderer/kept_images.h"

namespace sheen::renderer {

/// The table of E, built on all threads unless it was kept: to the bit the same.
albedo::Table kept_table(const KeptImages& kept, albedo::Visibility visibility);

}  // namespace sheen::renderer
