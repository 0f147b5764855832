//! Names of places in the code: one that no longer exists does not compile.

/// A function or a value of `centrode-core`, by its path.
macro_rules! function {
    ($first:ident $(:: $rest:ident)*) => {{
        let _ = centrode_core::$first $(::$rest)*;
        concat!(stringify!($first) $(, "::", stringify!($rest))*)
    }};
}

/// A type or a module of `centrode-core`, by its path.
macro_rules! item {
    ($first:ident $(:: $rest:ident)*) => {{
        #[allow(unused_imports)]
        use centrode_core::$first $(::$rest)* as _;
        concat!(stringify!($first) $(, "::", stringify!($rest))*)
    }};
}

/// A field of a type of `centrode-core`.
macro_rules! field {
    ($first:ident $(:: $rest:ident)* . $field:ident) => {{
        let _ = |of: &centrode_core::$first $(::$rest)*| {
            let _ = &of.$field;
        };
        concat!(stringify!($first) $(, "::", stringify!($rest))*, ".", stringify!($field))
    }};
}

pub(crate) use {field, function, item};
