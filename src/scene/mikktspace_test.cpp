// Held to the reference's own tangents (mikktspace_reference_test.h) and to laws that need no reference.
#include "scene/mikktspace.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "scene/mikktspace_reference_test.h"

namespace sheen::scene::test {
namespace {

struct Corners {
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec2> uvs;

  void add(const glm::vec3& position, const glm::vec3& normal, const glm::vec2& uv) {
    positions.push_back(position);
    normals.push_back(normal);
    uvs.push_back(uv);
  }
};

std::vector<glm::vec4> tangents_of(const Corners& corners) {
  return mikktspace(corners.positions, corners.normals, corners.uvs);
}

Corners inputs(const ReferenceMesh& mesh) {
  Corners corners;
  for (const ReferenceCorner& c : mesh.corners) {
    corners.add(c.position, c.normal, c.uv);
  }
  return corners;
}

const ReferenceMesh& reference_mesh(const std::string& name) {
  for (const ReferenceMesh& mesh : reference_meshes) {
    if (mesh.name == name) {
      return mesh;
    }
  }
  throw std::out_of_range(name);
}

bool defined(const glm::vec4& tangent) {
  return glm::vec3(tangent) != glm::vec3(0.0f);
}

// Relief of n x n vertices over the unit square, u along x and v against y, smooth normals.
Corners relief(int n) {
  const auto corner = [&](Corners& corners, int i, int j) {
    const float x = static_cast<float>(i) / static_cast<float>(n - 1);
    const float y = static_cast<float>(j) / static_cast<float>(n - 1);
    const glm::vec3 normal(-0.9f * std::cos(3 * x), 0.8f * std::sin(2 * y), 1.0f);
    corners.add({x, y, 0.3f * std::sin(3 * x) + 0.4f * std::cos(2 * y)}, glm::normalize(normal), {x + 0.1f * y, 1 - y * y});
  };
  Corners corners;
  for (int j = 0; j + 1 < n; ++j) {
    for (int i = 0; i + 1 < n; ++i) {
      corner(corners, i, j), corner(corners, i + 1, j), corner(corners, i + 1, j + 1);
      corner(corners, i, j), corner(corners, i + 1, j + 1), corner(corners, i, j + 1);
    }
  }
  return corners;
}

// The reference computes in float: an ulp of a unit vector is 6e-8, and a group sums a handful of angles. Its acos may differ in the last
// digit, and so may ours between machines.
constexpr float tolerance = 1e-6f;

TEST(Mikktspace, MeetsTheReferenceOnEveryMesh) {
  std::size_t compared = 0;
  std::size_t undefined = 0;
  for (const ReferenceMesh& mesh : reference_meshes) {
    const std::vector<glm::vec4> tangents = tangents_of(inputs(mesh));
    ASSERT_EQ(tangents.size(), mesh.corners.size());
    float worst = 0.0f;
    for (std::size_t i = 0; i < tangents.size(); ++i) {
      const glm::vec4& reference = mesh.corners[i].tangent;
      EXPECT_EQ(tangents[i].w, -reference.w) << mesh.name << " corner " << i << ": glTF's v grows down the image";
      if (!defined(tangents[i])) {
        const bool by_default = reference == glm::vec4(1, 0, 0, -1);
        EXPECT_TRUE(by_default || !defined(reference)) << mesh.name << " corner " << i << ": the reference finds a direction";
        ++undefined;
        continue;
      }
      const float error = glm::length(glm::vec3(tangents[i]) - glm::vec3(reference));
      EXPECT_LE(error, tolerance) << mesh.name << " corner " << i;
      worst = std::max(worst, error);
      ++compared;
    }
    RecordProperty(std::string("largest_error_") + mesh.name, std::to_string(worst));
  }
  // All of the mesh "degenerate": a corner whose triangle took the orientation of the other side (1), equal corners at a vertex of their
  // own (2), uv in a point (3), positions in a point (3), the ends of positions on a line, where the angle is zero (2).
  EXPECT_EQ(undefined, 11U);
  EXPECT_EQ(compared + undefined, 147U);
}

TEST(Mikktspace, TangentsAreUnitAndPerpendicularToTheNormal) {
  const Corners corners = relief(12);
  const std::vector<glm::vec4> tangents = tangents_of(corners);
  for (std::size_t i = 0; i < tangents.size(); ++i) {
    EXPECT_NEAR(glm::length(glm::vec3(tangents[i])), 1.0f, 5e-7f);
    EXPECT_NEAR(glm::dot(glm::vec3(tangents[i]), corners.normals[i]), 0.0f, 5e-7f);
  }
}

// glTF 2.0, section 3.9.3: green is up in the image, and v grows down.
TEST(Mikktspace, BitangentsPointTowardDecreasingV) {
  const Corners corners = relief(12);
  const std::vector<glm::vec4> tangents = tangents_of(corners);
  for (std::size_t i = 0; i < tangents.size(); ++i) {
    const glm::vec3 bitangent = glm::cross(corners.normals[i], glm::vec3(tangents[i])) * tangents[i].w;
    EXPECT_GT(bitangent.y, 0.0f) << "v decreases along y";
    EXPECT_GT(tangents[i].x, 0.0f) << "u grows along x";
  }
}

TEST(Mikktspace, TurningVOverKeepsTangentsAndTurnsTheirHandedness) {
  Corners corners = relief(6);
  const std::vector<glm::vec4> given = tangents_of(corners);
  for (glm::vec2& uv : corners.uvs) {
    uv.y = -uv.y;
  }
  const std::vector<glm::vec4> turned = tangents_of(corners);
  for (std::size_t i = 0; i < given.size(); ++i) {
    EXPECT_EQ(turned[i], glm::vec4(glm::vec3(given[i]), -given[i].w));
  }
}

TEST(Mikktspace, MirroringUTurnsTangentsAndHandedness) {
  Corners corners = relief(6);
  const std::vector<glm::vec4> given = tangents_of(corners);
  for (glm::vec2& uv : corners.uvs) {
    uv.x = -uv.x;
  }
  const std::vector<glm::vec4> mirrored = tangents_of(corners);
  for (std::size_t i = 0; i < given.size(); ++i) {
    EXPECT_EQ(mirrored[i], -given[i]);
  }
}

TEST(Mikktspace, TheOrderOfTrianglesAndOfTheirCornersDoesNotMatter) {
  const Corners corners = relief(5);
  const std::vector<glm::vec4> given = tangents_of(corners);
  const std::size_t count = corners.positions.size();
  Corners reordered;
  std::vector<std::size_t> from;
  for (std::size_t t = 0; t < count / 3; ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t corner = t * 21 % count + (i + t) % 3;
      from.push_back(corner);
      reordered.add(corners.positions[corner], corners.normals[corner], corners.uvs[corner]);
    }
  }
  const std::vector<glm::vec4> tangents = tangents_of(reordered);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_LE(glm::length(tangents[i] - given[from[i]]), tolerance) << "sums are rounded in another order, no more";
  }
}

TEST(Mikktspace, SmoothCornersOfAVertexAgree) {
  const Corners corners = relief(5);
  const std::vector<glm::vec4> tangents = tangents_of(corners);
  for (std::size_t i = 0; i < tangents.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (corners.positions[i] == corners.positions[j]) {
        EXPECT_EQ(tangents[i], tangents[j]);
      }
    }
  }
}

// Corners 0 and 3 of the quad are one vertex; its tangent is the mean by angle, which neither triangle has alone.
TEST(Mikktspace, AnyDifferenceInPositionNormalOrUvPartsAVertex) {
  const Corners whole = inputs(reference_mesh("quad"));
  const auto parted = [&](auto&& change) {
    Corners corners = whole;
    change(corners);
    const std::vector<glm::vec4> tangents = tangents_of(corners);
    return tangents[0] != tangents[3];
  };
  const auto up = [](float x) { return std::nextafter(x, 9.0f); };
  EXPECT_FALSE(parted([](Corners&) {}));
  EXPECT_FALSE(parted([](Corners& c) { c.positions[3].x = -0.0f; })) << "-0 equals 0";
  EXPECT_TRUE(parted([&](Corners& c) { c.positions[3].x = up(c.positions[3].x); }));
  EXPECT_TRUE(parted([&](Corners& c) { c.normals[3].z = up(c.normals[3].z); }));
  EXPECT_TRUE(parted([&](Corners& c) { c.uvs[3].y = up(c.uvs[3].y); }));
}

TEST(Mikktspace, DerivativesAlongTheNormalGiveNoDirection) {
  Corners corners;
  for (const glm::vec2 uv : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)}) {
    corners.add({uv.x, uv.y, 0}, {1, 0, 0}, uv);
  }
  for (const glm::vec4& tangent : tangents_of(corners)) {
    EXPECT_EQ(tangent, glm::vec4(0, 0, 0, -1));
  }
}

TEST(Mikktspace, ExtremeNumbersGiveUnitVectorsOrNone) {
  std::mt19937 random(3);
  const float values[] = {0.0f, -0.0f, 1.0f, -1.5f, 1e-45f, 1e-38f, 1e-22f, 1e-20f, 1e19f, -1e30f, 3e38f, INFINITY, -INFINITY, NAN};
  const auto value = [&] { return values[random() % std::size(values)]; };
  for (int round = 0; round < 5000; ++round) {
    Corners corners;
    for (int i = 0; i < 30; ++i) {
      const glm::vec3 position{value(), value(), value()};
      corners.add(position, {0, 0, 1}, {value(), value()});
    }
    for (const glm::vec4& tangent : tangents_of(corners)) {
      ASSERT_TRUE(!defined(tangent) || std::abs(glm::length(glm::vec3(tangent)) - 1.0f) < 1e-5f) << round;
      ASSERT_EQ(std::abs(tangent.w), 1.0f);
    }
  }
}

TEST(Mikktspace, UnequalLengthsAreRefused) {
  Corners corners = relief(2);
  corners.uvs.pop_back();
  EXPECT_THROW(tangents_of(corners), std::invalid_argument);
  corners.positions.pop_back();
  corners.normals.pop_back();
  EXPECT_THROW(tangents_of(corners), std::invalid_argument);
  EXPECT_TRUE(tangents_of({}).empty());
}

}  // namespace
}  // namespace sheen::scene::test
