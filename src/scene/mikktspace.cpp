#include "scene/mikktspace.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

#include <glm/geometric.hpp>

namespace sheen::scene {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// The reference's test of a length: what is smaller could not be divided by.
bool not_zero(float x) {
  return std::abs(x) > std::numeric_limits<float>::min();
}

glm::vec3 normalized(const glm::vec3& v) {
  return not_zero(v.x) || not_zero(v.y) || not_zero(v.z) ? v * (1.0f / glm::length(v)) : v;
}

// False, too, of what normalized() makes of a vector whose squared length overflows or loses its digits.
bool is_unit(const glm::vec3& v) {
  return std::abs(glm::length(v) - 1.0f) < 1e-5f;
}

glm::vec3 projected(const glm::vec3& v, const glm::vec3& normal) {
  return normalized(v - glm::dot(normal, v) * normal);
}

// Corner after and before corner i of a triangle.
constexpr std::size_t next(std::size_t i) {
  return (i + 1) % 3;
}
constexpr std::size_t previous(std::size_t i) {
  return (i + 2) % 3;
}

struct Mesh {
  std::span<const glm::vec3> positions, normals;
  std::span<const glm::vec2> uvs;
};

// A triangle whose three positions differ.
struct TangentTriangle {
  std::size_t first = 0;                                    // its first corner in the mesh
  std::array<std::uint32_t, 3> vertex{};                    // welded
  std::array<std::uint32_t, 3> neighbor{none, none, none};  // over the edge from corner i to the next
  std::array<bool, 3> grouped{};                            // whether the corner is in a group
  glm::vec3 along_u{0.0f};                                  // directions of dp/du and dp/dv, unit or zero
  glm::vec3 along_v{0.0f};
  bool preserving = false;  // the uv turn the way the positions do: det(duv) > 0
  bool any = true;          // without derivatives: joins any group
};

// Equal corners get the same number, that of the first. Bits are compared, -0 as +0, so that even NaN has an order.
std::vector<std::uint32_t> weld(const Mesh& mesh) {
  using Key = std::array<std::uint32_t, 8>;
  std::vector<std::pair<Key, std::uint32_t>> keys(mesh.positions.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const glm::vec3& p = mesh.positions[i];
    const glm::vec3& n = mesh.normals[i];
    const glm::vec2& uv = mesh.uvs[i];
    const std::array<float, 8> values{p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y};
    std::transform(values.begin(), values.end(), keys[i].first.begin(), [](float x) { return std::bit_cast<std::uint32_t>(x + 0.0f); });
    keys[i].second = static_cast<std::uint32_t>(i);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> vertex(keys.size());
  for (std::size_t i = 0, run = 0; i < keys.size(); ++i) {
    run = keys[i].first == keys[run].first ? run : i;
    vertex[keys[i].second] = keys[run].second;
  }
  return vertex;
}

// With d1, d2 the edges and (du, dv) their uv: dp/du = (d1 dv2 - d2 dv1) / det, dp/dv = (d2 du1 - d1 du2) / det (Mikkelsen 2008,
// equations 18 and 19).
void set_derivatives(const Mesh& mesh, TangentTriangle& triangle) {
  const glm::vec3* p = &mesh.positions[triangle.first];
  const glm::vec2* uv = &mesh.uvs[triangle.first];
  const glm::vec3 d1 = p[1] - p[0];
  const glm::vec3 d2 = p[2] - p[0];
  const glm::vec2 uv1 = uv[1] - uv[0];
  const glm::vec2 uv2 = uv[2] - uv[0];
  const float det = uv1.x * uv2.y - uv1.y * uv2.x;
  triangle.preserving = det > 0.0f;
  if (!not_zero(det)) {
    return;
  }
  const glm::vec3 du = uv2.y * d1 - uv1.y * d2;
  const glm::vec3 dv = -uv2.x * d1 + uv1.x * d2;
  const float u_length = glm::length(du);
  const float v_length = glm::length(dv);
  const float sign = triangle.preserving ? 1.0f : -1.0f;
  if (not_zero(u_length)) {
    triangle.along_u = (sign / u_length) * du;
  }
  if (not_zero(v_length)) {
    triangle.along_v = (sign / v_length) * dv;
  }
  triangle.any = !(not_zero(u_length / std::abs(det)) && not_zero(v_length / std::abs(det)));
}

std::vector<TangentTriangle> good_triangles(const Mesh& mesh, const std::vector<std::uint32_t>& vertex) {
  std::vector<TangentTriangle> triangles;
  triangles.reserve(vertex.size() / 3);
  for (std::size_t i = 0; i < vertex.size(); i += 3) {
    const glm::vec3* p = &mesh.positions[i];
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) {
      continue;
    }
    TangentTriangle& triangle = triangles.emplace_back();
    triangle.first = i;
    triangle.vertex = {vertex[i], vertex[i + 1], vertex[i + 2]};
    set_derivatives(mesh, triangle);
  }
  return triangles;
}

// An edge as one of its triangles sees it.
struct Edge {
  std::uint32_t low, high;  // its vertices
  std::uint32_t triangle;
  std::uint32_t side;  // from corner `side` to the next
};

// Two triangles are neighbours when they run along an edge in opposite directions. Where more than two meet, the first that waits takes the
// first that comes, in the triangles' order.
void find_neighbors(std::vector<TangentTriangle>& triangles) {
  std::vector<Edge> edges;
  edges.reserve(triangles.size() * 3);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(triangles[t].vertex[i], triangles[t].vertex[next(i)]);
      edges.push_back({low, high, t, i});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::array{a.low, a.high, a.triangle} < std::array{b.low, b.high, b.triangle};
  });
  const auto upwards = [&](const Edge& e) { return triangles[e.triangle].vertex[e.side] == e.low; };
  // Those of the run before `i` that wait all run the same way: of two opposite ones, the second would have taken the first.
  std::vector<std::size_t> waiting;
  std::size_t head = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i > 0 && (edges[i].low != edges[i - 1].low || edges[i].high != edges[i - 1].high)) {
      waiting.clear();
      head = 0;
    }
    if (head == waiting.size() || upwards(edges[waiting[head]]) == upwards(edges[i])) {
      waiting.push_back(i);
      continue;
    }
    const Edge& first = edges[waiting[head++]];
    triangles[first.triangle].neighbor[first.side] = edges[i].triangle;
    triangles[edges[i].triangle].neighbor[edges[i].side] = first.triangle;
  }
}

// A triangle at the vertex of a group.
struct Member {
  std::uint32_t triangle;
  std::uint32_t corner;
  bool any = true;
  glm::vec3 along_u{0.0f};  // as the triangle's, projected into the plane of the vertex's normal
  glm::vec3 along_v{0.0f};
  glm::vec3 contribution{0.0f};  // along_u times the triangle's angle at the vertex; zero for those that join any group or have none
};

// The group that starts at a corner, in the triangles' order.
void collect_group(std::vector<TangentTriangle>& triangles, std::uint32_t start, std::uint32_t corner, std::vector<Member>& members) {
  const std::uint32_t vertex = triangles[start].vertex[corner];
  const bool preserving = triangles[start].preserving;
  members.clear();
  std::vector<std::uint32_t> pending{start};
  while (!pending.empty()) {
    const std::uint32_t t = pending.back();
    pending.pop_back();
    TangentTriangle& triangle = triangles[t];
    const auto i = static_cast<std::size_t>(std::find(triangle.vertex.begin(), triangle.vertex.end(), vertex) - triangle.vertex.begin());
    if (triangle.grouped[i]) {
      continue;
    }
    // A triangle without orientation takes that of the first group it meets.
    if (triangle.any && triangle.grouped == std::array<bool, 3>{}) {
      triangle.preserving = preserving;
    }
    if (triangle.preserving != preserving) {
      continue;
    }
    triangle.grouped[i] = true;
    members.push_back({.triangle = t, .corner = static_cast<std::uint32_t>(i), .any = triangle.any});
    for (const std::uint32_t neighbor : {triangle.neighbor[i], triangle.neighbor[previous(i)]}) {
      if (neighbor != none) {
        pending.push_back(neighbor);
      }
    }
  }
  std::sort(members.begin(), members.end(), [](const Member& a, const Member& b) { return a.triangle < b.triangle; });
}

void set_contributions(const Mesh& mesh, const std::vector<TangentTriangle>& triangles, std::vector<Member>& members) {
  for (Member& member : members) {
    const TangentTriangle& triangle = triangles[member.triangle];
    const glm::vec3* p = &mesh.positions[triangle.first];
    const glm::vec3& normal = mesh.normals[triangle.first + member.corner];
    member.along_u = projected(triangle.along_u, normal);
    member.along_v = projected(triangle.along_v, normal);
    if (triangle.any) {
      continue;
    }
    const glm::vec3 to_previous = projected(p[previous(member.corner)] - p[member.corner], normal);
    const glm::vec3 to_next = projected(p[next(member.corner)] - p[member.corner], normal);
    const double cosine = std::clamp(static_cast<double>(glm::dot(to_previous, to_next)), -1.0, 1.0);
    member.contribution = is_unit(member.along_u) ? static_cast<float>(std::acos(cosine)) * member.along_u : glm::vec3(0.0f);
  }
}

// The threshold of 180 degrees compares with >, so that triangles whose derivatives are opposite to the last bit do not join.
bool joins(const Member& a, const Member& b) {
  return &a == &b || a.any || b.any || (glm::dot(a.along_u, b.along_u) > -1.0f && glm::dot(a.along_v, b.along_v) > -1.0f);
}

// Whether all derivatives clearly lie on one side of a line, so that no two can be opposite; spares the comparison of all pairs. Rounding
// makes a product -1 within some 5e-4 radians of opposite.
bool one_sided(const std::vector<Member>& members) {
  constexpr float least_cosine = 0.01f;
  const auto clear = [&](glm::vec3 Member::*along) {
    glm::vec3 sum(0.0f);
    for (const Member& m : members) {
      sum += m.any ? glm::vec3(0.0f) : m.*along;
    }
    const float least = least_cosine * glm::length(sum);
    return std::all_of(members.begin(), members.end(), [&](const Member& m) { return m.any || glm::dot(m.*along, sum) > least; });
  };
  return clear(&Member::along_u) && clear(&Member::along_v);
}

template <class Joins>
glm::vec3 mean(const std::vector<Member>& members, const Joins& joined) {
  glm::vec3 sum(0.0f);
  for (const Member& member : members) {
    if (joined(member)) {
      sum += member.contribution;
    }
  }
  const glm::vec3 tangent = normalized(sum);
  return is_unit(tangent) ? tangent : glm::vec3(0.0f);
}

void write_group(const std::vector<TangentTriangle>& triangles, const std::vector<Member>& members, std::vector<glm::vec4>& tangents) {
  const bool all_join = one_sided(members);
  const glm::vec3 of_all = mean(members, [](const Member&) { return true; });
  for (const Member& member : members) {
    const TangentTriangle& triangle = triangles[member.triangle];
    const glm::vec3 tangent = all_join ? of_all : mean(members, [&](const Member& other) { return joins(member, other); });
    tangents[triangle.first + member.corner] = glm::vec4(tangent, triangle.preserving ? -1.0f : 1.0f);
  }
}

// Corners of the triangles left out get the tangent of the first corner that is the same vertex.
void copy_to_degenerate(const std::vector<TangentTriangle>& triangles, const std::vector<std::uint32_t>& vertex,
                        std::vector<glm::vec4>& tangents) {
  std::vector<std::uint32_t> source(vertex.size(), none);
  std::vector<bool> good(vertex.size(), false);
  for (const TangentTriangle& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t corner = triangle.first + i;
      good[corner] = true;
      if (source[vertex[corner]] == none) {
        source[vertex[corner]] = static_cast<std::uint32_t>(corner);
      }
    }
  }
  for (std::size_t corner = 0; corner < vertex.size(); ++corner) {
    if (!good[corner] && source[vertex[corner]] != none) {
      tangents[corner] = tangents[source[vertex[corner]]];
    }
  }
}

}  // namespace

std::vector<glm::vec4> mikktspace(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                                  std::span<const glm::vec2> uvs) {
  if (normals.size() != positions.size() || uvs.size() != positions.size() || positions.size() % 3 != 0 || positions.size() >= none) {
    throw std::invalid_argument("mikktspace: positions, normals and uvs must be as many, three a triangle, fewer than 2^32 - 1");
  }
  const Mesh mesh{.positions = positions, .normals = normals, .uvs = uvs};
  const std::vector<std::uint32_t> vertex = weld(mesh);
  std::vector<TangentTriangle> triangles = good_triangles(mesh, vertex);
  find_neighbors(triangles);
  std::vector<glm::vec4> tangents(positions.size(), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
  std::vector<Member> members;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      if (!triangles[t].any && !triangles[t].grouped[i]) {
        collect_group(triangles, t, i, members);
        set_contributions(mesh, triangles, members);
        write_group(triangles, members, tangents);
      }
    }
  }
  copy_to_degenerate(triangles, vertex, tangents);
  return tangents;
}

}  // namespace sheen::scene
