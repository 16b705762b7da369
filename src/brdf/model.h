#pragma once

namespace sheen::brdf {

/// Which text the reflection of a material follows.
enum class Model {
  Ratified,   ///< glTF 2.0 Appendix B with KHR_materials_sheen and KHR_materials_clearcoat
  Draft2019,  ///< the same base and coat, but sheen as the extension's draft of 2019 had it; see draft_sheen.h
  Physical    ///< the base layer alone, reciprocal and conserving energy; see physical_base.h
};

}  // namespace sheen::brdf
