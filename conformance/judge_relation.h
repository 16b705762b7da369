#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "conformance/judge.h"
#include "conformance/relation.h"
#include "conformance/viewer.h"

namespace sheen::conformance {

/// Draws one scene: writes it to a file, asks the viewer.
struct Drawing {
  std::filesystem::path scene_file;
  Answer answer;
  std::optional<PreparedCase> prepared;  ///< of our own viewer: what its picture is held to
};

/// Has every scene of a relation drawn and judges the pictures, which are kept in `images`. Viewers of others by relate(). Our own, for
/// which no tolerance is picked: each picture by its golden, as any case's; what goldens keep (semantics_test.cpp) it then keeps within its
/// bounds. Besides, in highp, by relate() where the relation is exact: to the bit. A scene that the viewer does not draw decides the
/// status, and those after it are not asked for. A broken law with an excuse is an approximation of a viewer that takes no settings. Never
/// throws what `draw` throws as std::exception: it makes the relation invalid.
CaseResult judge_relation(const Relation& relation, const std::function<Drawing(const Case&)>& draw, const Hello& hello,
                          const std::filesystem::path& images);

}  // namespace sheen::conformance
