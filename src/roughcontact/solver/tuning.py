"""Numbers that decide how many products a solve takes, and which way is the cheapest.

A certified answer depends on none of them beyond its tolerance. Accuracies and rounding floors stand where they are
derived. "Counted" numbers come from `benchmarks/steps.py`, which counts products with each of them changed. "Timed"
ones come from `benchmarks/pairs.py --tuning NAME`, which times loads with each of them halved and doubled, in turn. The
others are safeguards: they act only on rare problems, which `benchmarks/robust.py` poses.
"""

# --- active_set: outer iteration, safeguards, except INNER_TOLERANCE ---
SCREENING_RESIDUAL = 0.2  # of the residual of a predicted set: how far it is solved to be screened
SCREENING_GRID = 4096  # cells of a plane up to which a guess is screened by steps on it, not on its matrix
SCREENING_CELLS = 300  # cells: a factorisation of fewer costs no more than some products
PLASTIC_FORCE = 0.5  # of the force: beyond the hardness, from which on almost no cell is between the bounds
PROGRESS = 0.9  # of the smallest residual so far: a larger one is no progress
ROUNDS_IN_SINGLE = 3  # rounds without progress after which only exact products are trusted
ROUNDS_AT_ALL = 12  # rounds without progress after which another method is tried
INNER_TOLERANCE = 0.3  # of the tolerance: residual of an inner solve

# --- bound_constrained_cg: counted, on 512 x 512 cells ---
INNER_FORCING = 0.2  # forcing term, of the residual: for an inner solve on a set that may still change
FREEING_ROUNDS = 20  # rounds of freeing cells between two exact products
MEAN_RESIDUAL = 0.01  # of the target of a run: mean residual on F that is not subtracted
BOUND_VIOLATION = 0.1  # of the target of a run: displacement of the largest pressure out of its bounds
LIFTED_RESIDUAL = 0.1  # of the residual: displacement of newly active cells that may be neglected, in total
TRIAL_STEP = 0.9  # of the step that is expected: length of the trial step
SHORTEST_STEP, LONGEST_STEP = 0.5, 1.1  # of a trial step with newly active cells: safeguard of alpha
ESTIMATE_AT_BOUNDS = 0.7, 1.1  # of the last estimate: safeguard of the next after such a step
ESTIMATE_FREE = 0.5, 1.5  # of the last estimate: after any other step
STALE_CONSTRAINT_DIRECTION = 0.03  # of the cells of F: lost ones after which M^-1 1 is computed again

# --- direct, inner_operator: which way to solve, timed ---
DIRECT_CELLS = 2000  # cells: a matrix of 32 MB; time grows with the third power beyond
DIRECT_BESIDE_TILES = 700  # cells, where some thirty products on few tiles or by shared transforms compete
DIRECT_ROUGHLY = 300  # cells, where the answer is but the start of another, against a few products
ROUGH_TOLERANCE = 1e-5  # tolerance of such an answer
# Of the unknowns: to deactivate one costs two triangular solves, a new factorisation a sixth of the cells as many.
DOWNDATED = 1 / 8
COMPILED_CELLS = 300  # cells up to which calls of LAPACK cost more than the slower elimination of the kernel
SINGLE_CELLS = 4_000  # cells from which on single precision halves the work: fewer bytes

# --- subdomain, prescribed: on which cells, timed ---
# A direct sum between the cells of a list is worth it while a quarter of their square (a typical contact
# is a quarter of the overlap) costs less than a transform of the padded box: in look-ups of the influence table a cell
# of the padded box. Transforms cost 0.3 to 0.7 (benchmarks/transforms.py), but a new box takes a kernel too.
LOOKUPS = 1.5
LIST_FILLING = 0.2  # of a box, up to which a list of cells is worth it where there are tiles
LARGE_BOX = 2**21  # cells of a box from which on each pass over it is worth sparing
SMALL_GRID = 4096  # cells up to which a list is part of the whole: a box costs a kernel of its own
KEPT_BOX = 1.3  # times the cells of a new box, up to which the last box is kept: its kernel is at hand
SMALLER_BOX = 0.5  # of the padded cells: a box that is worth a separate kernel

# --- nested_iteration: timed, and `benchmarks/ideas.py` ---
COARSEST = 64  # cells along the longer side at which a problem is solved from nothing
FACTOR_FOUR = 512  # cells along it up to which a level more costs more than the steps that it saves
COARSE_TOLERANCE = 1e-3  # no coarser answer deserves more: its grid is further from the fine one than that
SUMMITS = 2.0  # times as far as its cells stand out of its plane a block is raised above it
SLAB = 128  # rows of cells that are worked on at once, even

# --- polonsky_keer, plastic: safeguards ---
LEAP = 4.0  # times the smallest residual so far: a step that was too long
CYCLING = 10  # iterations without a smaller residual, after which cells of the wrong sign may cycle
PATIENCE = 500  # iterations without a smaller residual, after which the method has stagnated
PLASTIC_PATIENCE = 40  # the same where the depth can be sought instead: what converges needs fewer
DEPTH_TRIALS = 80  # depths: by bisection only, more than the digits of a depth
FORCE_CLOSE = 1e-9  # of the force: then the active sets are right, except for cells at the very edge
