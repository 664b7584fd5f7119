//! Which second derivatives a step is taken with.

/// The second derivatives in use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    Exact,
    /// Without the concave part of each element's own law: where a slack element is about to be pulled taut, `O` is concave in its
    /// deformation, and elements one after the other would keep the exact form from being used at all.
    Convexified,
    GaussNewton,
}

impl Form {
    /// Which of the second derivatives of [`super::saddle::Local`] and [`super::rows::Rows`].
    pub fn index(self) -> Option<usize> {
        match self {
            Self::Exact => Some(0),
            Self::Convexified => Some(1),
            Self::GaussNewton => None,
        }
    }
}

/// The reduced Hessian is not positive definite, or the system could not be solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct NotConvex;
