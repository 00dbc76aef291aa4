//! A number system that counts its operations.

use std::cell::Cell;
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use rayline::Vec3;
use rayline::math::{self, Kernel, Linear, Product, Real};

/// An `f32` that counts operations, separately for each thread.
#[derive(Clone, Copy, Debug)]
pub struct Counted(f32);

/// The numbers of operations by kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Operations {
    /// Sums and differences.
    pub sums: u64,
    /// Products.
    pub products: u64,
    /// Quotients, square roots and powers: 14 cycles or more each where a sum takes one.
    pub slow: u64,
    /// Comparisons.
    pub comparisons: u64,
}

impl Operations {
    /// The number of all operations.
    pub fn all(self) -> u64 {
        self.sums + self.products + self.slow + self.comparisons
    }
}

thread_local! {
    static OPERATIONS: Cell<Operations> = const { Cell::new(Operations::NONE) };
}

/// The result of `work`, and its operations on this thread.
pub fn operations_of<T>(work: impl FnOnce() -> T) -> (T, Operations) {
    OPERATIONS.set(Operations::NONE);
    let result = work();
    (result, OPERATIONS.get())
}

fn count(one: Operations) {
    let all = OPERATIONS.get();
    OPERATIONS.set(Operations {
        sums: all.sums + one.sums,
        products: all.products + one.products,
        slow: all.slow + one.slow,
        comparisons: all.comparisons + one.comparisons,
    });
}

fn slow(value: f32) -> Counted {
    count(Operations::SLOW);
    Counted(value)
}

impl PartialEq for Counted {
    fn eq(&self, other: &Self) -> bool {
        count(Operations::COMPARISON);
        self.0 == other.0
    }
}

impl PartialOrd for Counted {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        count(Operations::COMPARISON);
        self.0.partial_cmp(&other.0)
    }
}

impl Operations {
    const NONE: Self = Self { sums: 0, products: 0, slow: 0, comparisons: 0 };
    const SUM: Self = Self { sums: 1, ..Self::NONE };
    const PRODUCT: Self = Self { products: 1, ..Self::NONE };
    const SLOW: Self = Self { slow: 1, ..Self::NONE };
    const COMPARISON: Self = Self { comparisons: 1, ..Self::NONE };
}

impl Add for Counted {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        count(Operations::SUM);
        Self(self.0 + other.0)
    }
}

impl Sub for Counted {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        count(Operations::SUM);
        Self(self.0 - other.0)
    }
}

impl Mul for Counted {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        count(Operations::PRODUCT);
        Self(self.0 * other.0)
    }
}

impl Div for Counted {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        slow(self.0 / other.0)
    }
}

impl Neg for Counted {
    type Output = Self;
    // Not counted: a negation is mostly a part of the next operation.
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Product<Counted> for Counted {
    const ZERO: Self = Self(0.0);

    fn sqrt(self) -> Self {
        Real::sqrt(self)
    }

    fn times(self, factor: Self) -> Self {
        self * factor
    }

    fn over(self, divisor: Self) -> Self {
        self / divisor
    }

    fn share(self, whole: Self) -> Self {
        self / whole
    }
}

/// A linear function: three products and three sums.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CountedLinear {
    gradient: Vec3<Counted>,
    offset: Counted,
}

impl Linear<Counted> for CountedLinear {
    fn new(gradient: Vec3, zero: Vec3) -> Self {
        Self { gradient: Vec3::from_setup(gradient), offset: Counted(-gradient.dot(zero)) }
    }

    fn at(&self, point: Vec3<Counted>) -> Counted {
        self.gradient.dot(point) + self.offset
    }

    fn gradient(&self) -> Vec3 {
        self.gradient.to_setup()
    }

    fn offset(&self) -> f32 {
        self.offset.0
    }
}

impl Real for Counted {
    type Setup = f32;
    type Product = Self;
    type Factor = f32;
    type Linear = CountedLinear;

    const ZERO: Self = Self(0.0);
    const ONE: Self = Self(1.0);
    const FARTHEST: Self = Self(f32::FARTHEST);
    const RAY_OFFSET: Self = Self(f32::RAY_OFFSET);

    fn from_f32(value: f32) -> Self {
        Self(value)
    }

    fn to_f32(self) -> f32 {
        self.0
    }

    fn from_u16(value: u16) -> Self {
        Self(f32::from_u16(value))
    }

    fn from_fraction(value: u16) -> Self {
        Self(f32::from_fraction(value))
    }

    fn from_setup(value: f32) -> Self {
        Self(value)
    }

    fn to_setup(self) -> f32 {
        self.0
    }

    fn sqrt(self) -> Self {
        slow(Real::sqrt(self.0))
    }

    fn turn(y: Self, x: Self) -> Self {
        slow(Real::turn(y.0, x.0))
    }

    fn split(self) -> math::LatticeCoordinate<Self> {
        let math::LatticeCoordinate { index, within } = self.0.split();
        math::LatticeCoordinate { index, within: Self(within) }
    }

    fn floor_to_i32(self) -> i32 {
        self.0.floor_to_i32()
    }

    fn times(self, other: Self) -> Self {
        self * other
    }

    fn dot3_wide(a: [Self; 3], b: [Self; 3]) -> Self {
        Self::dot3(a, b)
    }
}

impl Kernel for Counted {
    fn tan(self) -> Self {
        slow(Kernel::tan(self.0))
    }

    fn factor(value: f32) -> f32 {
        value
    }

    fn powf(self, exponent: f32) -> Self {
        slow(Kernel::powf(self.0, exponent))
    }

    fn halved(self) -> Self {
        slow(Kernel::halved(self.0))
    }

    fn cell(self, per_unit: f32) -> i32 {
        self.0.cell(per_unit)
    }

    fn to_q16(self) -> u32 {
        self.0.to_q16()
    }
}
