//! Signed integers of a few machine words: [`Wide`].

use super::scaled::Scaled;
use crate::Sign;
use crate::polynomial::Additive;

/// A two's-complement integer of `L` words, least significant first. Arithmetic is modulo `2^(64 L)`; the callers'
/// sizes are such that nothing wraps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Wide<const L: usize>([u64; L]);

impl Wide<1> {
    #[inline(always)]
    pub(crate) fn of_i64(value: i64) -> Self {
        Self([value as u64])
    }
}

impl Wide<2> {
    #[inline(always)]
    pub(crate) fn of_i128(value: i128) -> Self {
        Self([value as u64, (value >> 64) as u64])
    }
}

impl<const L: usize> Wide<L> {
    /// All ones if negative, else zero.
    #[inline(always)]
    fn sign_word(&self) -> u64 {
        ((self.0[L - 1] as i64) >> 63) as u64
    }

    /// The same number in more words.
    #[inline(always)]
    pub(crate) fn widened<const M: usize>(self) -> Wide<M> {
        const { assert!(M >= L) };
        let fill = self.sign_word();
        Wide(core::array::from_fn(|i| if i < L { self.0[i] } else { fill }))
    }

    /// The exact product of two numbers.
    #[inline(always)]
    pub(crate) fn product<const A: usize, const B: usize>(a: Wide<A>, b: Wide<B>) -> Self {
        const { assert!(L == A + B) };
        let mut result = [0u64; L];
        for i in 0..A {
            let mut carry = 0;
            for j in 0..B {
                let t =
                    u128::from(a.0[i]) * u128::from(b.0[j]) + u128::from(result[i + j]) + u128::from(carry);
                result[i + j] = t as u64;
                carry = (t >> 64) as u64;
            }
            result[i + B] = carry;
        }
        // As unsigned numbers, negative factors count 2^(64 A) or 2^(64 B) too much.
        let (a_sign, b_sign) = (a.sign_word(), b.sign_word());
        subtract_at(&mut result, A, b.0.map(|word| word & a_sign));
        subtract_at(&mut result, B, a.0.map(|word| word & b_sign));
        Self(result)
    }

    #[inline(always)]
    pub(crate) fn sign(&self) -> Sign {
        if self.sign_word() != 0 {
            return Sign::Negative;
        }
        let mut any = 0;
        for word in self.0 {
            any |= word;
        }
        if any == 0 { Sign::Zero } else { Sign::Positive }
    }

    /// The leading bits, in units of 1.
    pub(crate) fn scaled(&self) -> Scaled {
        let negative = self.sign_word() != 0;
        let magnitude = if negative { Self([0; L]).minus(self).0 } else { self.0 };
        let Some(top) = magnitude.iter().rposition(|&word| word != 0) else { return Scaled::ZERO };
        let below = if top > 0 { magnitude[top - 1] } else { 0 };
        Scaled::of_words(negative, magnitude[top], below, 64 * (top as i32 - 1))
    }
}

/// Subtracts `words` shifted up by `offset` words; what lies above is dropped.
#[inline(always)]
fn subtract_at<const L: usize, const M: usize>(from: &mut [u64; L], offset: usize, words: [u64; M]) {
    let mut borrow = false;
    for (i, word) in words.into_iter().enumerate() {
        let (d, b1) = from[offset + i].overflowing_sub(word);
        let (d, b2) = d.overflowing_sub(u64::from(borrow));
        from[offset + i] = d;
        borrow = b1 | b2;
    }
}

impl<const L: usize> Additive for Wide<L> {
    #[inline(always)]
    fn plus(&self, other: &Self) -> Self {
        let mut carry = false;
        Self(core::array::from_fn(|i| {
            let (s, c1) = self.0[i].overflowing_add(other.0[i]);
            let (s, c2) = s.overflowing_add(u64::from(carry));
            carry = c1 | c2;
            s
        }))
    }

    #[inline(always)]
    fn minus(&self, other: &Self) -> Self {
        let mut result = self.0;
        subtract_at(&mut result, 0, other.0);
        Self(result)
    }
}

#[cfg(test)]
mod tests {
    use super::super::scaled::power_of_two;
    use super::*;

    #[test]
    fn products_of_all_signs() {
        let square = |a: i64| Wide::of_i128(i128::from(a) * i128::from(a));
        for a in [0i64, 1, -1, 12345, -98765, i64::MAX, i64::MIN + 1] {
            for b in [0i64, 1, -1, -777, i64::MAX, i64::MIN + 1] {
                let product = i128::from(a) * i128::from(b);
                let ab = Wide::of_i128(product);
                assert_eq!(Wide::product(Wide::of_i64(a), Wide::of_i64(b)), ab);
                assert_eq!(ab.sign() as i128, product.signum());
                // a^2 b, a^3 b^2 by two ways each.
                let a2b = Wide::<3>::product(ab, Wide::of_i64(a));
                assert_eq!(a2b, Wide::product(Wide::of_i64(b), square(a)));
                assert_eq!(a2b.plus(&a2b).minus(&a2b), a2b);
                let a3b2 = Wide::<5>::product(ab, a2b);
                let other: Wide<4> = Wide::product(square(a), square(b));
                assert_eq!(a3b2, Wide::product(other, Wide::of_i64(a)));
            }
        }
    }

    #[test]
    fn leading_bits() {
        let three = Wide::of_i128(3i128 << 100);
        assert_eq!(three.scaled().to_f64(), 3.0 * power_of_two(100));
        let cube = Wide::<3>::product(three, Wide::of_i64(-(1i64 << 40)));
        assert_eq!(cube.scaled().to_f64(), -3.0 * power_of_two(140));
        assert_eq!(cube.minus(&cube).scaled(), Scaled::ZERO);
    }
}
