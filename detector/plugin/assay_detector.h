/* The C interface of a detector that wants to be certified: a shared library with one symbol,
 * assay_detector(), which returns a table of functions. C99 or C++; no library is needed to build
 * one. tests/plugins/example.c is an example; README.md here has one in C++. A host calls it so:
 *
 *   const assay_detector_api* detector = assay_detector();
 *   if (detector->create(triangles, m, positions, n, &handle, &message)) return report(message);
 *   if (detector->evaluate(handle, x_t0, x_t1) == ASSAY_OK &&
 *       detector->result(handle, &result) == ASSAY_OK)
 *     use(result.answer);
 *   detector->destroy(handle);
 *
 * A detector is given a mesh once and then steps of this mesh: over t in [0,1] every vertex moves
 * linearly from x_t0 to x_t1. It answers whether the mesh touches itself, when it first does, and
 * which triangles meet. Two triangles are in contact when a vertex, edge or face of one meets one
 * of the other that shares no vertex with it; touching counts, and so do t = 0 and t = 1. The
 * doubles given are exact numbers, in the user's units of length. Times are fractions of the step.
 * A detector that keeps a distance is asked which triangles come within it (separation, below).
 *
 * MEMORY. Nothing allocated on one side is freed on the other. Arrays that the host passes are
 * valid during the call and must not be written. Arrays and texts that the detector returns are
 * its own; they stay valid until the next call with the same handle.
 *
 * THREADS. A handle is used by one thread at a time; several handles may be used at once by
 * different threads, so a detector keeps no mutable global data (or guards it).
 *
 * ERRORS are return codes. No exception, longjmp or exit() may cross this border: the host counts
 * them as crashes. A call that fails changes nothing; the handle stays valid.
 *
 * ORDER. create; then any number of (evaluate, result, and commit where the host accepts the
 * step); destroy. A step usually starts where the last committed one ended. When it starts
 * elsewhere, it is a new start: nothing carried from earlier steps may be trusted.
 *
 * LEFT OUT. A step that the description's contract leaves out, such as one that starts in contact,
 * is never given to the detector, and the next step is a new start.
 *
 * PARTS. A library may hold less than a detector of whole steps: one elementary query
 * (vertex-face, edge-edge), the candidate pairs of a broad phase, or a limiter, which says how far
 * a step may be taken. It fills in the functions that it has and sets the others to NULL. evaluate,
 * commit and result stand together; they, candidates and limit need create and destroy.
 *
 * VERSIONS. abi_version is the first member of the table in every version. Members are only ever
 * added at the end, and then the version goes up. This host loads tables of older versions too: of
 * version 1 it reads the table up to destroy and the description up to margin, of version 2 the
 * table up to error_text and the description up to reports, and it takes the other members to be
 * 0. It refuses a table whose version is above its own. */
#ifndef ASSAY_DETECTOR_H
#define ASSAY_DETECTOR_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define ASSAY_DETECTOR_ABI_VERSION 3u

#if defined(_WIN32)
#define ASSAY_DETECTOR_EXPORT __declspec(dllexport)
#else
#define ASSAY_DETECTOR_EXPORT __attribute__((visibility("default")))
#endif

/* Return codes. */
enum {
  ASSAY_OK = 0,
  ASSAY_REFUSED = 1,       /* the input is outside of what this detector takes */
  ASSAY_OUT_OF_MEMORY = 2, /* the step counts as undecided */
  ASSAY_FAILED = 3         /* anything else */
};

/* `refused: capacity`: the mesh, or this step of it, is more than the detector holds. It is a
 * return code of create, evaluate, result, candidates and limit, and also an answer of a step. If a
 * number of the description's capacity is exceeded, this answer is counted and breaks no claim.
 * Otherwise it is a refusal like any other. Beyond the capacity nothing else is excused: an answer
 * that is given has to be right. */
enum { ASSAY_BEYOND_CAPACITY = 4 };

/* The claims of the detector. It is judged by these and by nothing else. t* is the first contact
 * time of the step. */
enum {
  ASSAY_CLAIM_FREE_SOUND = 1u << 0,    /* the answer is never `free` when there is a contact */
  ASSAY_CLAIM_NOT_LATE = 1u << 1,      /* first_lo <= t* */
  ASSAY_CLAIM_FIRST_TIME = 1u << 2,    /* first_lo <= t* <= first_hi */
  ASSAY_CLAIM_FIRST_PAIRS = 1u << 3,   /* each connected part of the contact graph at t* (triangles
                                          as nodes, contacts as edges) holds a reported pair */
  ASSAY_CLAIM_ALL_PAIRS = 1u << 4,     /* every pair in contact during the step is reported, none
                                          with a time later than its first contact */
  ASSAY_CLAIM_NO_SPURIOUS = 1u << 5,   /* no collision, pair or contact time is reported before
                                          there is a contact */
  ASSAY_CLAIM_DETERMINISTIC = 1u << 6, /* the same calls give the same results */
  ASSAY_CLAIM_TOTAL = 1u << 7,         /* every valid input within the limits of time and memory is
                                          answered */
  ASSAY_CLAIM_CANDIDATES = 1u << 8,    /* every pair in contact is among those that the table's
                                          `candidates` gives */
  /* Claims of the table's `limit`, in steps that start without a contact. With a separation, read
   * `comes within it` for contact. */
  ASSAY_CLAIM_COMMIT_FREE = 1u << 9, /* the straight step from x_t0 to the positions that it allows
                                        has no contact */
  ASSAY_CLAIM_PATH_FREE = 1u << 10,  /* the share of the step that it allows is below t* */
  ASSAY_CLAIM_PROGRESS = 1u << 11,   /* that share is at least progress * t*, with t* = 1 if nothing
                                        is in contact. Judged where this share moves some vertex by
                                        2^10 units in its last place, and all gaps at the start are
                                        2^6 units of the largest coordinate or more; units are those
                                        of the contract's coordinates */
  ASSAY_CLAIM_WHOLE = 1u << 12       /* a step without a contact may be taken whole */
};

/* Which pairs of neighbouring triangles the detector tests. A contact of a pair that it does not
 * test is counted, but not held against it. */
enum {
  ASSAY_ADJACENCY_ALL = 0,              /* every pair of triangles */
  ASSAY_ADJACENCY_NOT_EDGE_SHARING = 1, /* pairs that share at most one vertex */
  ASSAY_ADJACENCY_NO_SHARED_VERTEX = 2  /* pairs that share nothing */
};

enum {
  ASSAY_COORDINATES_FLOAT64 = 0,
  ASSAY_COORDINATES_FLOAT32 = 1 /* every coordinate is a float32 in a double: it was rounded before
                                   the detector and the oracle see it */
};

/* Which steps the detector takes, by how the mesh lies at t = 0. All others are left out. */
enum {
  ASSAY_START_ANY = 0,  /* every step */
  ASSAY_START_FREE = 1, /* steps that start without a contact */
  /* Steps in which every vertex and face, and every two edges, without a common vertex are
   * start_distance or more apart at t = 0. */
  ASSAY_START_APART = 2
};

/* Which pairs of features the detector tests. Contacts that it cannot find in this way are
 * counted, but not held against it. If it tests one kind alone, these are the contacts of the other
 * kind, and of edges that already pierce a face when the step starts. */
enum { ASSAY_FEATURES_BOTH = 0, ASSAY_FEATURES_VERTEX_FACE = 1, ASSAY_FEATURES_EDGE_EDGE = 2 };

enum {
  ASSAY_REPORTS_PAIRS = 0,
  ASSAY_REPORTS_NO_PAIRS = 1 /* it gives the answer and the time but no pairs; its claims on pairs
                                (first-pairs, all-pairs) are not judged */
};

/* Says which pairs a relation is about: of triangles, or of features, which are a vertex and a
 * face, or two edges, that share no vertex. With features, a pair of triangles counts by its
 * counted feature pairs; an edge that pierces a face at t = 0 counts if some feature pair of the
 * two triangles does. */
enum { ASSAY_COUNTS_TRIANGLES = 0, ASSAY_COUNTS_FEATURES = 1 };

/* How a step's end is given. With displacements, every function that has an x_t1 is given x_t1 -
 * x_t0 in its place, and vertex i moves from x to x + d, the exact sum of two float32 numbers. Its
 * coordinates are float32. A limiter's share 1 means the float32 nearest to that sum. */
enum { ASSAY_MOTION_ENDS = 0, ASSAY_MOTION_DISPLACEMENT = 1 };

/* Where the caller stops if a limiter states a share of the step: at positions that the limiter
 * gives itself, or at those that the caller's own code computes from the share. The host computes
 * these as that code does, in the contract's coordinates, one rounding an operation. */
enum {
  ASSAY_LIMIT_POSITIONS = 0,  /* the limiter gives the positions */
  ASSAY_LIMIT_START_PLUS = 1, /* x_t0 + share * (x_t1 - x_t0) */
  ASSAY_LIMIT_BLEND = 2       /* (1 - share) * x_t0 + share * x_t1 */
};

#define ASSAY_WIDEST_TIME_TOLERANCE 1e-3

/* The detector's name, its claims, and its contract: all members from adjacency on. A contract
 * whose members are all 0 leaves nothing out. A description that sets only the members up to margin
 * has the contract of version 1. */
typedef struct assay_description {
  const char* name;    /* one line, not empty */
  const char* version; /* one line */
  uint32_t claims;     /* ASSAY_CLAIM_..., or-ed */
  int32_t adjacency;   /* ASSAY_ADJACENCY_... */
  int32_t coordinates; /* ASSAY_COORDINATES_... */
  double margin;       /* a slack, user's units; finite, >= 0: it may also report triangles that
                          come within separation + margin. If it is above 0, first-time is not
                          judged, and no-spurious only with ASSAY_ADJACENCY_NO_SHARED_VERTEX */

  /* Since version 2. */
  int32_t start;         /* ASSAY_START_... */
  double start_distance; /* user's units; above 0 with ASSAY_START_APART, else 0 */
  /* The sizes that the detector takes, user's units. No coordinate has a magnitude above largest,
   * because rounding depends on coordinates. Edges and extents are 0 long, or least_nonzero or
   * more, because thresholds depend on lengths; a length is the greatest difference along an axis.
   * Single coordinates may be as small as they like. Both 0: every finite number. Else 0 <=
   * least_nonzero <= largest and largest is above 0. Meshes beyond the range are left out. */
  double least_nonzero;
  double largest;
  int32_t features;      /* ASSAY_FEATURES_... */
  double time_tolerance; /* a time counts as late, early or wrong when it is off by more than this
                            share of the step; 0 <= time_tolerance <= 1e-3 */
  int32_t reports;       /* ASSAY_REPORTS_... */

  /* Since version 3. */
  double separation; /* user's units; finite, >= 0. Above 0, the question is which triangles come
                        within this distance, 0 included, in place of which touch: read `within
                        separation` wherever a claim says `in contact`. It needs
                        ASSAY_ADJACENCY_NO_SHARED_VERTEX, as neighbours are near throughout. The
                        elementary query is then about two features that come within it. */
  /* The pairs left out, besides neighbours. The mesh at rest is that given to create. */
  int32_t counts;       /* ASSAY_COUNTS_...: rings and rest_distance are about pairs of these */
  int32_t rings;        /* pairs joined by a path of fewer edges of the mesh; 0: no such pairs */
  double rest_distance; /* pairs nearer to each other at rest, user's units; 0: no such pairs */
  int32_t limit_gives;  /* ASSAY_LIMIT_...: where the caller stops if it is told a share alone */
  double progress;      /* what ASSAY_CLAIM_PROGRESS promises: above 0, at most 1; else 0 */
  int32_t motion;       /* ASSAY_MOTION_... */
  /* How much the detector holds; 0: no limit. Beyond it, it may answer ASSAY_BEYOND_CAPACITY. */
  uint64_t capacity_triangles;  /* of the mesh */
  uint64_t capacity_contacts;   /* pairs of triangles in contact during the step that its contract
                                   does not leave out */
  uint64_t capacity_candidates; /* pairs of features (a vertex and a face, two edges) that share no
                                   vertex and whose boxes around their whole way meet, or come
                                   within the separation */
} assay_description;

/* The members of the contract, for code that treats them all alike: X(kind, name, the version that
 * added it). An integer is an int32_t, a real a double, a count a uint64_t. */
/* clang-format off */
#define ASSAY_CONTRACT_MEMBERS(X) \
  X(integer, adjacency, 1) X(integer, coordinates, 1) X(real, margin, 1) X(integer, start, 2) \
  X(real, start_distance, 2) X(real, least_nonzero, 2) X(real, largest, 2) X(integer, features, 2) \
  X(real, time_tolerance, 2) X(integer, reports, 2) X(real, separation, 3) X(integer, counts, 3) \
  X(integer, rings, 3) X(real, rest_distance, 3) X(integer, limit_gives, 3) X(real, progress, 3) \
  X(integer, motion, 3) X(count, capacity_triangles, 3) X(count, capacity_contacts, 3) \
  X(count, capacity_candidates, 3)
/* clang-format on */

/* The detector's own data of one mesh. */
typedef struct assay_handle assay_handle;

enum { ASSAY_FREE = 0, ASSAY_COLLISION = 1, ASSAY_UNDECIDED = 2, ASSAY_ERROR = 3 };

/* The result of a step. The host sets all members to 0 before the call. */
typedef struct assay_result {
  int32_t answer; /* ASSAY_FREE, ASSAY_COLLISION, ASSAY_UNDECIDED, ASSAY_ERROR,
                     ASSAY_BEYOND_CAPACITY */
  /* With ASSAY_COLLISION: the interval of the first contact time, 0 <= first_lo <= first_hi <= 1.
   * [0, 1] states nothing about the time. */
  double first_lo;
  double first_hi;
  uint64_t pair_count;      /* pairs of triangles in contact; any order, each once or more */
  const int32_t* pairs;     /* pair_count x 2 triangle indices; may be NULL when there are none */
  const double* pair_times; /* pair_count x 2, lo and hi of each pair's first contact. NULL when
                               the times are not known: then pairs are judged without times */
  const char* message;      /* with ASSAY_ERROR: one line, or NULL */
} assay_result;

/* Which pairs do not count; all others count. A pair that does not count is not to be reported, and
 * makes no step a collision. Below, "the two" are two triangles or two features, as the level
 * says. */
typedef struct assay_counted_pairs {
  int32_t level; /* ASSAY_COUNTS_... */
  /* vertex_count numbers of bodies from 0 on, or NULL: all vertices are of body 0. The vertices of
   * a triangle are of one body. */
  const int32_t* body;
  uint64_t apart_count;
  const int32_t* apart; /* apart_count x 2: bodies a, b do not meet; a, a: a does not meet itself */
  int32_t rings;        /* the two are joined by a path of fewer edges; 0: not used */
  double rest_distance; /* the two are nearer to each other at rest; 0: not used */
  const double* rest;   /* vertex_count x 3 places at rest; NULL if rest_distance is 0 */
  uint64_t triangle_pair_count;
  const int32_t* triangle_pairs; /* triangle_pair_count x 2; of triangles only */
  uint64_t vertex_face_count;
  const int32_t* vertex_faces; /* vertex_face_count x 2: vertex, triangle; of features only */
  uint64_t edge_pair_count;
  const int32_t* edge_pairs; /* edge_pair_count x 4: two vertices an edge; of features only */
} assay_counted_pairs;

enum { ASSAY_QUERY_VERTEX_FACE = 0, ASSAY_QUERY_EDGE_EDGE = 1 };

/* The result of one elementary query. The host sets all members to 0 before the call. */
typedef struct assay_query_result {
  int32_t answer;  /* ASSAY_FREE, ASSAY_COLLISION, ASSAY_UNDECIDED, ASSAY_ERROR */
  double first_lo; /* first_lo and first_hi are as in assay_result */
  double first_hi;
} assay_query_result;

/* The pairs of triangles that a broad phase finds: those that may be in contact during the step.
 * The host sets all members to 0 before the call. */
typedef struct assay_candidates {
  uint64_t pair_count;  /* any order, each once or more */
  const int32_t* pairs; /* pair_count x 2 triangle indices; may be NULL when there are none */
} assay_candidates;

/* How far a caller may go in a step. The host sets share to -1 and positions to NULL before the
 * call. Share 1 means x_t1 itself. Share 0, or the positions of x_t0, means that the mesh stays. A
 * limiter that limits each vertex by itself gives positions alone. */
typedef struct assay_limit {
  double share;            /* of the step, 0 to 1, or -1: not stated */
  const double* positions; /* vertex_count x 3, finite: where the caller stops. NULL: where the
                              description's limit_gives says */
} assay_limit;

typedef struct assay_detector_api {
  uint32_t abi_version; /* ASSAY_DETECTOR_ABI_VERSION */

  /* Describes the detector: the same at every call, valid while the library is loaded. */
  const assay_description* (*describe)(void);

  /* Makes a handle for a mesh. triangles: triangle_count x 3 vertex indices, counter-clockwise seen
   * from outside. positions: vertex_count x 3 doubles of the first frame. The detector must copy
   * what it needs of them later. The mesh may be open, of several parts, or already in contact with
   * itself. With a return code other than ASSAY_OK the function leaves *handle alone, and may set
   * *message to a line of static text. */
  int32_t (*create)(const int32_t* triangles, uint64_t triangle_count, const double* positions,
                    uint64_t vertex_count, assay_handle** handle, const char** message);

  /* Answers the step from x_t0 to x_t1, each vertex_count x 3 finite doubles. It leaves alone the
   * state that is carried from step to step: commit advances that. */
  int32_t (*evaluate)(assay_handle* handle, const double* x_t0, const double* x_t1);

  /* Accepts the step evaluated last: the state advances to the end of that step. */
  int32_t (*commit)(assay_handle* handle);

  /* Fills in the result of the step evaluated last. */
  int32_t (*result)(assay_handle* handle, assay_result* result);

  /* Frees the handle. */
  void (*destroy)(assay_handle* handle);

  /* Since version 2. Each of these functions may be NULL. */

  /* Says how many threads the detector may use, 1 or more. Called once, before every function but
   * describe. If the detector claims deterministic, results must not depend on the number. */
  void (*use_threads)(uint32_t count);

  /* Answers whether two features meet during the step, and when first. This elementary query is a
   * part of its own (PARTS above), judged by `check`, `self-test` and campaigns of queries. kind:
   * ASSAY_QUERY_... x_t0 and x_t1 are 4 x 3 doubles each: the vertex and the three corners of the
   * face, or the two ends of one edge and the two ends of the other. It needs no handle. */
  int32_t (*query)(int32_t kind, const double* x_t0, const double* x_t1,
                   assay_query_result* result);

  /* Gives the pairs that may be in contact during the step. This is a broad phase, judged by
   * ASSAY_CLAIM_CANDIDATES. It carries nothing from step to step. */
  int32_t (*candidates)(assay_handle* handle, const double* x_t0, const double* x_t1,
                        assay_candidates* candidates);

  /* Returns why the last failed call of this thread failed, whichever function it was: one line,
   * valid until the next call, or NULL. The host asks at once after a return code other than
   * ASSAY_OK, after an ASSAY_ERROR without a message, and after a describe() that returns NULL. */
  const char* (*error_text)(void);

  /* Since version 3. Each of these functions may be NULL. */

  /* Is called once, before the first step, with the pairs that count, unless all do. The
   * detector must copy what it needs later. A library without this function is asked about all
   * pairs. */
  int32_t (*count)(assay_handle* handle, const assay_counted_pairs* counted);

  /* Says how far the step may be taken. A part of its own (PARTS), without state between steps. */
  int32_t (*limit)(assay_handle* handle, const double* x_t0, const double* x_t1,
                   assay_limit* limit);
} assay_detector_api;

/* The one symbol that a plug-in exports. The table is valid as long as the library is loaded. */
ASSAY_DETECTOR_EXPORT const assay_detector_api* assay_detector(void);

#ifdef __cplusplus
}
#endif

#endif
