// Vectors, rotations and a least-squares solver. A matrix is a list of rows; a quaternion is [w, x, y, z].
const add = (a, b) => a.map((x, k) => x + b[k]);
const minus = (a, b) => a.map((x, k) => x - b[k]);
const times = (c, a) => a.map((x) => c * x);
const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);
const norm = (a) => Math.hypot(...a);
const cross = ([a, b, c], [x, y, z]) => [b * z - c * y, c * x - a * z, a * y - b * x];
const onto = (M, v) => M.map((row) => dot(row, v));
const transposed = (M) => M[0].map((_, k) => M.map((row) => row[k]));
const product = (M, N) => M.map((row) => transposed(N).map((column) => dot(row, column)));

/** The turn by a rotation vector. */
function turnBy(v) {
  const angle = norm(v);
  const [s, c] = angle > 1e-8 ? [Math.sin(angle) / angle, (1 - Math.cos(angle)) / angle ** 2] : [1, 0.5];
  const [x, y, z] = v;
  const K = [[0, -z, y], [z, 0, -x], [-y, x, 0]];
  const KK = product(K, K);
  return K.map((row, i) => row.map((k, j) => (i === j ? 1 : 0) + s * k + c * KK[i][j]));
}

function matrixOf([w, x, y, z]) {
  return [
    [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
    [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
    [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
  ];
}

function quaternionOf(R) {
  const four = [1 + R[0][0] + R[1][1] + R[2][2], 1 + R[0][0] - R[1][1] - R[2][2], 1 - R[0][0] + R[1][1] - R[2][2], 1 - R[0][0] - R[1][1] + R[2][2]];
  const k = four.indexOf(Math.max(...four));
  const [a, b, c] = [R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]];
  const [d, e, f] = [R[1][0] + R[0][1], R[0][2] + R[2][0], R[2][1] + R[1][2]];
  const rows = [[four[0], a, b, c], [a, four[1], d, e], [b, d, four[2], f], [c, e, f, four[3]]];
  return times(1 / norm(rows[k]), rows[k]);
}

/** Q = Rz(yaw) Ry(pitch) Rx(roll), and back. */
const turnOf = ([roll, pitch, yaw]) => product(turnBy([0, 0, yaw]), product(turnBy([0, pitch, 0]), turnBy([roll, 0, 0])));
const anglesOf = (Q) => [Math.atan2(Q[2][1], Q[2][2]), Math.atan2(-Q[2][0], Math.hypot(Q[2][1], Q[2][2])), Math.atan2(Q[1][0], Q[0][0])];

/** A = Σ sizes[k] left[k] right[k]ᵀ by one-sided Jacobi turns, the largest first. */
function singular(A) {
  const columns = transposed(A).map((column) => Float64Array.from(column));
  const V = columns.map((_, k) => Float64Array.from(columns, (__, i) => (i === k ? 1 : 0)));
  const squared = (a, b) => {
    let sum = 0;
    for (let k = 0; k < a.length; ++k) sum += a[k] * b[k];
    return sum;
  };
  const turn = (p, q, c, s) => {
    for (let k = 0; k < p.length; ++k) [p[k], q[k]] = [c * p[k] - s * q[k], s * p[k] + c * q[k]];
  };
  for (let sweep = 0, off = 1; sweep < 60 && off > 1e-15; ++sweep) {
    off = 0;
    for (let i = 0; i < columns.length; ++i)
      for (let j = i + 1; j < columns.length; ++j) {
        const c = squared(columns[i], columns[j]);
        if (Math.abs(c) <= 1e-300) continue;
        const [a, b] = [squared(columns[i], columns[i]), squared(columns[j], columns[j])];
        const share = Math.abs(c) / Math.sqrt(a * b);
        if (share <= 1e-16) continue;
        off = Math.max(off, share);
        const zeta = (b - a) / (2 * c);
        const t = (zeta < 0 ? -1 : 1) / (Math.abs(zeta) + Math.hypot(1, zeta));
        const cosine = 1 / Math.hypot(1, t);
        turn(columns[i], columns[j], cosine, cosine * t);
        turn(V[i], V[j], cosine, cosine * t);
      }
  }
  const all = columns.map((column, k) => ({ size: norm(column), column: [...column], right: [...V[k]] })).sort((a, b) => b.size - a.size);
  return all.map(({ size, column, right }) => ({ size, right, left: size > 0 ? times(1 / size, column) : column }));
}

const no_size = 1e-10; // of the largest
const ofRank = (parts) => parts.filter(({ size }) => size > no_size * parts[0].size);
/** The shortest x with the least |Aᵀ x − b|. */
const solvedTransposed = (parts, b) => ofRank(parts).reduce((x, { size, left, right }) => add(x, times(dot(right, b) / size, left)), parts[0].left.map(() => 0));

/** A short x with small |A x − b|, by the normal equations: good enough for a step of Newton's method, and quick. */
function step(A, b) {
  const n = A[0].length;
  const L = transposed(A).map((column, i, all) => Float64Array.from(all, (other, j) => (j <= i ? dot(column, other) : 0)));
  const little = 1e-13 * L.reduce((sum, row, i) => sum + row[i], 0);
  const x = transposed(A).map((column) => dot(column, b));
  for (let i = 0; i < n; ++i) {
    for (let j = 0; j <= i; ++j) {
      let left = L[i][j] + (i === j ? little : 0);
      for (let k = 0; k < j; ++k) left -= L[i][k] * L[j][k];
      L[i][j] = i === j ? Math.sqrt(Math.max(left, little)) : left / L[j][j];
    }
    for (let k = 0; k < i; ++k) x[i] -= L[i][k] * x[k];
    x[i] /= L[i][i];
  }
  for (let i = n - 1; i >= 0; --i) {
    for (let k = i + 1; k < n; ++k) x[i] -= L[k][i] * x[k];
    x[i] /= L[i][i];
  }
  return x;
}
