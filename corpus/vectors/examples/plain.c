/* The textbook test: solve the cubic of coplanarity, and test its roots for an overlap of features.
   It is a short detector, not a good one. Build: cc -std=c99 -O2 plain.c -o plain -lm */
#include <math.h>
#include <stdio.h>
#include <string.h>

static double p[2][4][3], c[4]; /* the points at t = 0, and their motions; the cubic */
static int edges;               /* true: two edges; false: a vertex and a face */
static double dot(double *a, double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static double det(double *a, double *b, double *d) {
  return a[0] * (b[1] * d[2] - b[2] * d[1]) + a[1] * (b[2] * d[0] - b[0] * d[2]) +
         a[2] * (b[0] * d[1] - b[1] * d[0]);
}
static double cubic(double t) { return ((c[3] * t + c[2]) * t + c[1]) * t + c[0]; }
/* Tests features in one plane: the solution of r = s u + w v tells whether they overlap. */
static int overlap(double t) {
  double x[4][3], r[3], u[3], v[3];
  for (int i = 0; i < 12; ++i) x[i / 3][i % 3] = p[0][i / 3][i % 3] + t * p[1][i / 3][i % 3];
  for (int k = 0; k < 3; ++k) {
    r[k] = edges ? x[2][k] - x[0][k] : x[0][k] - x[1][k];
    u[k] = edges ? x[1][k] - x[0][k] : x[2][k] - x[1][k];
    v[k] = edges ? x[2][k] - x[3][k] : x[3][k] - x[1][k];
  }
  double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), g = uu * vv - uv * uv;
  double s = (dot(r, u) * vv - dot(r, v) * uv) / g, w = (dot(r, v) * uu - dot(r, u) * uv) / g;
  return s >= 0 && w >= 0 && (edges ? s <= 1 && w <= 1 : s + w <= 1);
}
static double first_time(void) { /* a root in [0,1] at which the features overlap, or -1 */
  double d[2][3][3], ends[4] = {0, 0, 1, 1};
  for (int i = 0; i < 18; ++i) /* each point minus the first */
    d[i / 9][i / 3 % 3][i % 3] = p[i / 9][i / 3 % 3 + 1][i % 3] - p[i / 9][0][i % 3];
  memset(c, 0, sizeof c);
  for (int i = 0; i < 8; ++i)
    c[(i & 1) + (i >> 1 & 1) + (i >> 2)] += det(d[i & 1][0], d[i >> 1 & 1][1], d[i >> 2][2]);
  double root = sqrt(c[2] * c[2] - 3 * c[3] * c[1]); /* NaN if the derivative has no zero */
  double q = -(c[2] + copysign(root, c[2])), a = q / (3 * c[3]), b = c[1] / q;
  if (fmin(a, b) > 0 && fmin(a, b) < 1) ends[1] = fmin(a, b);
  if (fmax(a, b) > 0 && fmax(a, b) < 1) ends[2] = fmax(a, b);
  for (int i = 0; i < 3; ++i) { /* between two ends the cubic rises or falls: bisection */
    double lo = ends[i], hi = ends[i + 1], sign = cubic(lo);
    if (sign * cubic(hi) > 0 || lo == hi) continue;
    for (int n = 0; n < 60; ++n) *(cubic((lo + hi) / 2) * sign > 0 ? &lo : &hi) = (lo + hi) / 2;
    if (overlap(hi)) return hi;
  }
  return -1;
}
int main(void) {
  for (char word[32]; scanf("%31s", word) == 1; fflush(stdout)) {
    edges = strcmp(word, "edge-edge") == 0;
    if (edges || strcmp(word, "vertex-face") == 0) {
      for (int i = 0; i < 24; ++i) scanf("%lf", &p[i / 12][i / 3 % 4][i % 3]);
      for (int i = 0; i < 12; ++i) p[1][i / 3][i % 3] -= p[0][i / 3][i % 3];
      double t = first_time();
      t < 0 ? puts("free") : printf("collision %.17g\n", t);
    } else { /* another question, or the host's greeting: the rest of the line is skipped */
      puts(strcmp(word, "assay-vectors") ? "unsupported" : "plain-c 1 textbook cubic in doubles");
      scanf("%*[^\n]");
    }
  }
}
