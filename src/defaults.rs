//! Every default of the tool, in one place: value, unit, and source or reason.
//!
//! "Guess to calibrate" marks a figure for which no reliable source was found. The moduli are two-dimensional, the
//! plushie's thickness multiplied in (N/mm).

/// Shear modulus `mu` of the stuffed body, N/mm. Guess to calibrate: fibre filling is of the order of some kPa, here
/// 6.5 kPa over 60 mm of thickness.
pub const MU: f64 = 0.4;
/// Modulus `kappa` of eq. 5 (it acts as the first Lame parameter), N/mm. Guess to calibrate: stuffing is compressible,
/// and linear triangles lock above about ten times `MU`.
pub const KAPPA: f64 = 0.6;

/// Stiffness `K` of a muscle fibre, N/mm (the taut stiffness of eq. 8 is 2K). A muscle of the idealized plushie is
/// virtual: as stiff as the body, so that full contraction can bend it strongly and no fibre is needlessly stiff.
pub const FIBER_STIFFNESS: f64 = 0.3;
/// Smoothing half-width `epsilon` of a fibre (eq. 8), as a fraction of the mean edge length. Small enough to be
/// invisible, large enough for a well-conditioned Newton step.
pub const FIBER_EPSILON_FRACTION: f64 = 0.01;
/// Largest contraction of a fibre as a fraction of its rest length. Virtual muscles may go far; real ones reach 0.3.
pub const FIBER_MAX_CONTRACTION: f64 = 0.6;

/// Stiffness `K` of a tendon, N/mm. 0.5 mm fishing line over 200 mm is about 5 N/mm.
pub const TENDON_STIFFNESS: f64 = 5.0;
/// Smoothing half-width `epsilon` of a tendon (eq. 8), mm: below what a winch resolves.
pub const TENDON_EPSILON_MM: f64 = 0.2;
/// Largest contraction of a tendon as a fraction of its rest length: beyond half, felt bunches up.
pub const TENDON_MAX_CONTRACTION: f64 = 0.5;
/// Coefficient of friction of a cable at its holes in a new design, dimensionless. A guess, to be replaced by a measured one: tables give
/// 0.15 to 0.25 for nylon on nylon (Engineering ToolBox, "Friction coefficients", clean and dry), and none was found for line through felt or
/// eyelets of a plushie. Measured as strings on tennis felt are (USRSA): a turn of line over a felt roller, `ln(pull/hold)/angle`.
pub const NEW_FRICTION: f64 = 0.2;

/// Stiffness of a pin, N/mm: a pinned point moves under a micrometre per mN while the matrix stays well conditioned.
pub const PIN_STIFFNESS: f64 = 20.0;

/// Weight `w` of the rest shape in the posing objective, relative to a target (dimensionless, section 5: "greatly
/// reduced").
pub const REST_WEIGHT: f64 = 1e-3;
/// Weight of squared tension in the posing objective is this over `mu^2`, with lengths in body lengths: the smallest that
/// keeps the choice between equivalent fibres unique and smooth.
pub const TENSION_WEIGHT: f64 = 1e-4;

/// Number of heaviest fibres that seed a network (SEED_NUM of Algorithm 2).
pub const SEED_NUM: usize = 24;
/// Rounds of joining (JOIN_DEPTH of Algorithm 2).
pub const JOIN_DEPTH: usize = 3;
/// Largest number of edges of a joining path (JOIN_LEN of Algorithm 2).
pub const JOIN_LEN: usize = 3;
/// Tendons of a network (TENDON_NUM of Algorithm 2).
pub const TENDON_NUM: usize = 2;
/// Trade between a large mean and a small spread of the tendons' net contractions (phi of Algorithm 2).
pub const PHI: f64 = 0.5;
/// Rounds of the joint search for winches: half a minute of one core for three poses and 414 fibres, after which gains are rare.
pub const RIG_ROUNDS: usize = 60;

/// Plushies that are sewn in thought to see what a hand's inaccuracy costs: an odd number has a median, five tell a routing that works from
/// one that works by chance.
pub const SEWN_DRAWS: usize = 5;
/// How far a hole is from its mark there, mm: a darning needle set by eye on a pencil mark in felt. Unconfirmed.
pub const SEWN_HOLE_MM: f64 = 2.0;
/// How far a winch is from its place, mm: its housing is held by more than one stitch. Unconfirmed.
pub const SEWN_WINCH_MM: f64 = 1.0;

/// Muscle fibres of a new design, unless its file brings its own mesh. The paper's designs have 276 to 571. A new design has no
/// default height: it is as large as its file says (plain numbers of an SVG and pixels measure 1/96 inch, those of a DXF or OBJ
/// 1 mm), and one that is small for a plushie is told.
pub const FIBERS: usize = 414;

/// Seam allowance, mm. Shop guides for hand-made plush: 6 to 10.
pub const SEAM_ALLOWANCE_MM: f64 = 8.0;
/// Hole for a tendon in the felt, mm: a blunt large-eyed needle for 0.5 mm line. Unconfirmed (1 to 3).
pub const TENDON_HOLE_MM: f64 = 1.5;
/// Opening left in the seam to turn and stuff the body, mm.
pub const TURNING_GAP_MM: f64 = 50.0;
/// Least distance from a hole to the seam, mm: nearer, the needle meets the stitches. For this and the rules below: felt of 2 to 3 mm, a hand, a
/// darning needle; unconfirmed.
pub const HOLE_TO_SEAM_MM: f64 = 5.0;
/// Least distance between two holes, mm.
pub const HOLE_TO_HOLE_MM: f64 = 8.0;
/// Most holes of a cable between its winch and its end.
pub const MOST_HOLES: usize = 8;
/// Largest turn of a cable at one hole, degrees.
pub const TURN_DEGREES: f64 = 75.0;
/// Largest sum of all turns of a cable, degrees: at a friction of 0.2 that leaves 0.28 of the tension.
pub const TURNING_DEGREES: f64 = 360.0;
/// Cables nearer than this run along each other, mm.
pub const BESIDE_MM: f64 = 3.0;
/// Longest stretch of a cable along another one, mm.
pub const ALONG_MM: f64 = 10.0;
/// Length from the winch on which cables may run together, mm.
pub const LEAD_MM: f64 = 20.0;
/// Diameter of a winch's housing, mm: a small gearmotor and its spool.
pub const HOUSING_MM: f64 = 24.0;
/// Least space between two housings, mm.
pub const BETWEEN_HOUSINGS_MM: f64 = 5.0;
/// Radius of the printed spool's core, mm.
pub const SPOOL_RADIUS_MM: f64 = 10.0;
/// Encoder lines per motor revolution (counts are four times as many). Faulhaber IE2-512.
pub const ENCODER_LINES: u32 = 512;
/// Gear ratio between motor and spool. A common planetary gearhead; set it to yours.
pub const GEAR_RATIO: f64 = 43.0;
/// Rate of the winch tracks, Hz.
pub const TRACK_RATE_HZ: f64 = 50.0;
/// Largest motor speed that the plan of an animation asks for, rpm. Unconfirmed: depends on the motor.
pub const MOTOR_SPEED_RPM: u32 = 5000;
/// Largest motor acceleration that the plan of an animation asks for, rev/s^2. Unconfirmed: depends on the load.
pub const MOTOR_ACCELERATION: u32 = 200;
/// Torque that a winch may ask of its motor all the time, at the spool, N mm. Unconfirmed: some 2 mN m of a small DC motor of 17 mm, times the gear
/// ratio above, less a quarter lost in the gears.
pub const MOTOR_TORQUE_NMM: f64 = 65.0;
/// Speed of the line to controllers of the classic family, baud: theirs from the factory.
pub const BAUD: u32 = 9600;
/// Current limit of a motor with such a controller, mA: enough for a small DC motor of 17 mm to reach the torque above, too little to tear felt. Unconfirmed:
/// depends on the motor.
pub const MOTOR_CURRENT_MA: u32 = 500;
/// Unit of `DELAY` in their stored programs, s. Unconfirmed.
pub const DELAY_UNIT_S: f64 = 0.01;
/// Range of a hobby servo, degrees.
pub const SERVO_DEGREES: f64 = 180.0;
/// Pulses at the ends of that range, microseconds. Unconfirmed: many servos reach a stop before.
pub const SERVO_PULSES_US: [u32; 2] = [500, 2500];
/// Steps for a turn of a spool on a stepper of 1.8 degrees with 16 microsteps.
pub const STEPS_PER_TURN: f64 = 3200.0;
/// Seconds between keyframes where the tool lays them out itself.
pub const KEYFRAME_SPACING_S: f64 = 1.0;
