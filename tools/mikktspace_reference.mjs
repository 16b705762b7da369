// Prints src/scene/mikktspace_reference_test.h: small meshes and the tangents that the npm package `mikktspace` gives them (the MikkTSpace
// reference in WebAssembly, by way of gltf-rs/mikktspace). The package is looked for from the current folder:
//
//     npm install mikktspace@1.1.1 && node .../tools/mikktspace_reference.mjs > .../src/scene/mikktspace_reference_test.h
import {createRequire} from 'node:module';
import {join} from 'node:path';

const require = createRequire(join(process.cwd(), 'here.js'));
const {generateTangents} = require('mikktspace');
const {version} = require('mikktspace/package.json');

// A mesh is a list of corners [position, normal, uv], three a triangle.
const triangles = (vertices, indices) => indices.map((i) => vertices[i]);
const Z = [0, 0, 1];

const meshes = {};

meshes.quad = {
  what: 'Two triangles of a tilted, unevenly mapped quad.',
  corners: triangles(
      [
        [[0, 0, 0], [0.6, 0, 0.8], [0.125, 0.875]],
        [[2, 0.25, -1.5], [0.6, 0, 0.8], [1, 1]],
        [[2.25, 1.5, -1.5], [0.6, 0, 0.8], [0.75, 0.125]],
        [[0.25, 1, 0], [0.6, 0, 0.8], [0, 0]],
      ],
      [0, 1, 2, 0, 2, 3]),
};

// Rings 0 (the pole), 1, 2 of a sphere of `columns`; at the seam the positions of column 0 return with u = 1.
function sphere(columns) {
  const vertex = (ring, column, u = column) => {
    const theta = ring * 0.9;
    const phi = 2 * Math.PI * (column % columns) / columns;
    const p = ring === 0 ? [0, 1, 0] : [Math.sin(theta) * Math.cos(phi), Math.cos(theta), -Math.sin(theta) * Math.sin(phi)];
    const snapped = p.map((x) => (Math.abs(x) < 1e-9 ? 0 : x));
    return [snapped, snapped, [u / columns, theta / Math.PI]];
  };
  const corners = [];
  for (let c = 0; c < columns; ++c) {
    corners.push(vertex(0, c, c + 0.5), vertex(1, c), vertex(1, c + 1));
    corners.push(vertex(1, c), vertex(2, c), vertex(2, c + 1));
    corners.push(vertex(1, c), vertex(2, c + 1), vertex(1, c + 1));
  }
  return corners;
}
meshes.sphere = {what: 'Part of a sphere: a pole whose corners differ in u, and a seam.', corners: sphere(4)};

meshes.mirrored = {
  what: 'Two quads that share an edge, where u turns back: the vertices of the edge are equal but get two tangents each.',
  corners: triangles(
      [
        [[-1, 0, 0], [-0.28, 0, 0.96], [1, 1]], [[0, 0, 0.25], Z, [0, 1]], [[1, 0, 0], [0.28, 0, 0.96], [1, 1]],
        [[-1, 1, 0], [-0.28, 0, 0.96], [1, 0]], [[0, 1, 0.25], Z, [0, 0]], [[1, 1, 0], [0.28, 0, 0.96], [1, 0]],
      ],
      [0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4]),
};

meshes.degenerate = {
  what: 'Triangles without area: equal positions, uv on a line between two orientations, uv in a point, positions on a line.',
  corners: triangles(
      [
        [[0, 0, 0], Z, [0, 1]], [[1, 0, 0], Z, [1, 1]], [[1, 1, 0.5], Z, [1, 0]],           // 0 1 2
        [[2, 0.5, 0], Z, [1, 0.5]], [[2.5, 2, 0], Z, [0.25, 0]],                            // 3 4
        [[5, 5, 5], Z, [0.5, 0.5]], [[6, 5, 5], Z, [0.5, 0.5]], [[6, 6, 5], Z, [0.5, 0.5]],  // 5 6 7
        [[-1, 0.5, 1], Z, [0.25, 0.5]], [[0, -1, 1], Z, [0.5, 0.25]], [[0, 4, 1], Z, [1, 1]],  // 8 9 10
      ],
      [
        3, 2, 1,   // uv on a line: before either neighbour, whose orientations differ
        2, 3, 4,   // good, mirrored: its orientation is the one taken
        0, 1, 2,   // good
        0, 2, 2,   // equal positions, at vertices of a good one
        10, 10, 0, // equal positions, one vertex of its own
        5, 6, 7,   // uv a point, apart
        5, 5, 5,   // a point, apart
        0, 8, 9,   // good, touches at a vertex alone
      ]),
};
// Over the edge of a good triangle: positions on a line, but uv with area.
meshes.degenerate.corners.push([[1, 0, 0], Z, [1, 1]], [[0, 0, 0], Z, [0, 1]], [[0.5, 0, 0], Z, [0.5, 0.25]]);
// Turned, so that no tangent is the (1, 0, 0) of a vertex without one; in dyadic steps, so that lines stay lines.
meshes.degenerate.corners = meshes.degenerate.corners.map(([p, n, [u, v]]) => [p, n, [0.5 * u + 0.75 * v, 0.5 * v - 0.75 * u]]);

const face = (normal, a, b, c, d) => [[a, [0, 1]], [b, [1, 1]], [c, [1, 0]], [a, [0, 1]], [c, [1, 0]], [d, [0, 0]]].map(
    ([p, uv]) => [p, normal, uv]);
meshes.hard_edges = {
  what: 'Three faces of a box around a corner: normals part vertices that positions share.',
  corners: [
    ...face([0, 0, 1], [0, 0, 1], [2, 0, 1], [2, 1, 1], [0, 1, 1]),
    ...face([1, 0, 0], [2, 0, 1], [2, 0, 0], [2, 1, 0], [2, 1, 1]),
    ...face([0, 1, 0], [0, 1, 1], [2, 1, 1], [2, 1, 0], [0, 1, 0]),
  ],
};

meshes.touching = {
  what: 'Two triangles that touch at one vertex without sharing an edge: each keeps its own direction.',
  corners: [
    [[0, 0, 0], Z, [0, 0]], [[1, 0, 0], Z, [1, 0]], [[1, 1, 0], Z, [1, 1]],
    [[0, 0, 0], Z, [0, 0]], [[-1, 0, 0], Z, [0, 1]], [[-1, -1, 0], Z, [-1, 1]],
  ],
};

meshes.folded = {
  what: 'Two triangles over an edge, folded so that dp/du is opposite to the last bit: even 180 degrees part them.',
  corners: triangles(
      [[[0, 0, 0], Z, [0, 0]], [[0, 1, 0], Z, [0, 1]], [[1, 0, 0], Z, [1, 0]], [[1, 0.5, 0], Z, [-1, 0.5]]], [0, 2, 1, 0, 1, 3]),
};

// Numbers in [0, n), the same on every machine (Park and Miller 1988).
function random(seed) {
  let state = seed;
  return (n) => {
    state = state * 48271 % 2147483647;
    return Math.floor(state / 2147483647 * n);
  };
}

function soup(seed, vertices, count) {
  const below = random(seed);
  const coordinate = () => (below(65) - 32) / 16;
  const pool = [];
  for (let i = 0; i < vertices; ++i) {
    const n = [coordinate(), coordinate(), coordinate() + 2.5];
    const length = Math.hypot(...n);
    pool.push([[coordinate(), coordinate(), coordinate()], n.map((x) => x / length), [below(33) / 32, below(33) / 32]]);
  }
  const indices = [];
  while (indices.length < 3 * count) indices.push(below(vertices));
  return triangles(pool, indices);
}
meshes.soup = {what: 'Random triangles over few vertices: edges that more than two share, both windings, mirrored uv.', corners: soup(5, 7, 12)};

// The shortest decimals that give the float back.
function shortest(x) {
  const value = Math.fround(x);
  for (let digits = 1; digits <= 9; ++digits) {
    const text = String(Number(value.toPrecision(digits)));
    if (Math.fround(Number(text)) === value) return text === '-0' ? '0' : text;
  }
  return String(value);
}
const literal = (x) => (/[.e]/.test(shortest(x)) ? shortest(x) : shortest(x) + '.') + 'F';

function rows(corners) {
  const column = (i) => new Float32Array(corners.flatMap((corner) => corner[i]));
  const tangents = generateTangents(column(0), column(1), column(2));
  return corners.map((corner, i) => {
    const groups = [...corner, [...tangents.slice(4 * i, 4 * i + 4)]];
    return '    {' + groups.map((g) => '{' + g.map(literal).join(', ') + '}').join(', ') + '},';
  });
}

const out = [
  '// Written by tools/mikktspace_reference.mjs; do not edit. The tangents are those of the npm package `mikktspace` ' + version + ' (MIT, by Don',
  '// McCurdy: gltf-rs/mikktspace, a port of the reference by Morten S. Mikkelsen, in WebAssembly), as it gives them, w not negated.',
  '#pragma once', '', '#include <span>', '', '#include <glm/vec2.hpp>', '#include <glm/vec3.hpp>', '#include <glm/vec4.hpp>', '',
  'namespace sheen::scene::test {', '',
  '/// A corner of a triangle and the tangent of the reference.',
  'struct ReferenceCorner {', '  glm::vec3 position, normal;', '  glm::vec2 uv;', '  glm::vec4 tangent;', '};', '',
  'struct ReferenceMesh {', '  const char* name;', '  std::span<const ReferenceCorner> corners;', '};', '', '// clang-format off',
];
for (const [name, {what, corners}] of Object.entries(meshes)) {
  out.push('// ' + what, `inline const ReferenceCorner ${name}_corners[] = {`, ...rows(corners), '};', '');
}
out.push('inline const ReferenceMesh reference_meshes[] = {');
out.push(...Object.keys(meshes).map((name) => `    {"${name}", ${name}_corners},`));
out.push('};', '// clang-format on', '', '}  // namespace sheen::scene::test');
console.log(out.join('\n'));
